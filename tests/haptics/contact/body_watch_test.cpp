#include "ode_predictive_space/haptics/contact/body_watch.h"

#include "tests/haptics/support/probe_world.h"

#include <gtest/gtest.h>
#include <memory>
#include <random>

namespace ode_predictive_space::haptics
{
namespace
{
const Vector3 push_force = {1, 2, 3}; // N

std::uintptr_t name(dBodyID body)
{
    return reinterpret_cast<std::uintptr_t>(body);
}

class BodyWatchTest : public testing::Test
{
protected:
    const OdeUse ode_;
    ProbeWorld world_;
    BodyWatch watch_;
};

TEST_F(BodyWatchTest, BodiesGoInAnyOrderAndNewOnesMayHaveTheirAddresses)
{
    std::mt19937 random(7);
    std::vector<dBodyID> bodies;
    for (int i = 0; i < 3000; ++i)
    {
        if (bodies.size() < 20)
            bodies.push_back(world_.add_body({0, 0, 0}, 1));
        const std::size_t which = random() % bodies.size();
        const dBodyID body = bodies[which];
        if (random() % 3 == 0)
        {
            const bool known = dBodyGetNumJoints(body) > 0;
            EXPECT_EQ(watch_.push(name(body), push_force, {0, 0, 0}), known);
            dBodyDestroy(body);
            EXPECT_FALSE(watch_.push(name(body), push_force, {0, 0, 0}));
            bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(which));
        }
        else
        {
            watch_.keep(body);
        }
        if (random() % 4 == 0)
            watch_.age();
    }
}

TEST_F(BodyWatchTest, AWorldMayGoBeforeItsWatch)
{
    auto world = std::make_unique<ProbeWorld>();
    const dBodyID body = world->add_body({0, 0, 0}, 1);
    watch_.keep(body);
    world.reset();
    EXPECT_FALSE(watch_.push(name(body), push_force, {0, 0, 0}));
    watch_.age();
    const dBodyID another = world_.add_body({0, 0, 0}, 1);
    watch_.keep(another);
    EXPECT_TRUE(watch_.push(name(another), push_force, {0, 0, 0}));
}
} // namespace
} // namespace ode_predictive_space::haptics
