// Idle objects: disabled objects are in no reported pair, so their pairs are neither searched nor kept.

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
TEST(IdleAtRandom, ReportsTheOverlappingPairsOfEnabledObjects)
{
    constexpr std::size_t count = 200;
    std::uint64_t sweeps = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
        Random random(seed);
        World world;
        const auto anywhere = [&] {
            Object object = ball(random.vector(0.5), 0.1, random.chance(0.5) ? random.vector(0.001) : Vector3::Zero());
            object.enabled = random.chance(0.5);
            return object;
        };
        for (std::size_t i = 0; i < count; ++i)
            world.add(anywhere());
        for (int tick = 0; tick < 600; ++tick)
        {
            world.advance();
            const bool all = random.chance(0.02), scattered = tick % 200 > 180;
            for (ProxyId id : world.members())
            {
                if (random.chance(all ? 0.5 : 0.01))
                    world.object(id).enabled = !world.object(id).enabled;
                if (scattered || world.object(id).centre.cwiseAbs().maxCoeff() > 0.6)
                    world.place(id, random.vector(0.5));
            }
            const ProxyId id = static_cast<ProxyId>(random.index(count));
            if (random.chance(0.1) && world.present(id))
            {
                world.remove(id);
                world.add(anywhere());
            }
            if (random.chance(0.1))
                world.broadphase.catch_up(world);
            ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping()) << "seed " << seed << ", tick " << tick;
            ASSERT_EQ(sorted_pairs(world.report()), world.overlapping()) << "seed " << seed << ", again " << tick;
        }
        sweeps += world.broadphase.counters().sweeps;
    }
    EXPECT_GT(sweeps, 100u) << "when all are scattered";
    EXPECT_LT(sweeps, 1200u) << "half of the ticks";
}
} // namespace
} // namespace ode_predictive_space
