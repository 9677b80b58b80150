// Both implementations of the vector arithmetic give the same bits: two test programs with this file expect the same constants.

#include <cstring>

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
class Hash
{
public:
    template <typename Value> void add(const Value &value)
    {
        unsigned char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        for (unsigned char byte : bytes)
            value_ = (value_ ^ byte) * 0x100000001b3u;
    }

    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

class Swarm
{
public:
    static constexpr std::size_t count = 300;

    Swarm()
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            const Vector3 centre = random_.vector(1.5), displacement = random_.vector(0.003);
            const Vector3 half = Vector3(0.1, 0.06, 0.03);
            world.add(i % 4 == 0   ? ball(centre, 0.1, displacement)
                      : i % 4 == 1 ? capsule(centre, 0.05, 0.1, displacement)
                      : i % 4 == 2 ? box(centre, half, displacement, true)
                                   : block(centre, half, displacement, false));
        }
    }

    void tick()
    {
        for (ProxyId id : world.members())
        {
            Object &object = world.object(id);
            object.displacement.z() -= id % 3 == 0 ? 1e-5 : 0;
            if (object.velocity)
                object.velocity = object.displacement / World::step;
            if (random_.chance(0.1))
                world.turn(id, {1, 0.5, 0.25}, random_.uniform(-1, 1));
        }
        world.advance();
        world.tick();
    }

    World world;

private:
    Random random_{1};
};

// A change of the formulas changes this number. Both programs must agree on the new one; the commit states the change.
TEST(Twin, TightBoxesEnvelopesAndNearPairsAreTheSameToTheLastBit)
{
    Swarm flock;
    Hash hash;
    for (int tick = 0; tick < 200; ++tick)
    {
        flock.tick();
        for (const Place &place : flock.world.broadphase.proxies().places)
        {
            hash.add(place.envelope());
            hash.add(place.tight());
        }
        flock.world.broadphase.for_each_near_pair([&](const CandidatePair &pair, PairState) { hash.add(pair); });
    }
    EXPECT_GT(flock.world.broadphase.counters().repredictions, 2 * Swarm::count);
    EXPECT_EQ(hash.value(), 2658144747074183715u);
}
} // namespace
} // namespace ode_predictive_space
