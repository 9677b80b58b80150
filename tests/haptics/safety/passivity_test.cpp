#include "ode_predictive_space/haptics/safety/passivity.h"

#include <gtest/gtest.h>
#include <utility>

#include "tests/haptics/safety/simulated_hand.h"
#include "tests/haptics/support/constants.h"

namespace ode_predictive_space::haptics
{
namespace
{
DeviceState state_at(double position, double velocity = 0)
{
    DeviceState state;
    state.position.x() = position;
    state.linear_velocity.x() = velocity;
    return state;
}

TEST(Passivity, ObservesWhatTheHandPutsIn)
{
    PassivityController controller(0);
    controller.control(state_at(0), Vector3(2, 0, 0), dt);
    EXPECT_EQ(controller.energy(), 0);
    controller.control(state_at(-0.01), Vector3(3, 0, 0), dt); // 1 cm against 2 N
    EXPECT_NEAR(controller.energy(), 0.02, 1e-15);
    controller.control(state_at(0), Vector3(1, 0, 0), dt); // and back with 3 N
    EXPECT_NEAR(controller.energy(), -0.01, 1e-15);
    EXPECT_EQ(controller.damping(), 0); // it may only observe
}

TEST(Passivity, DoesNothingToWhatIsPassive)
{
    PassivityController controller(5);
    SimulatedHand hand;
    hand.damping = 2;
    hand.push = -1;
    SimulatedWall wall(500, 0);
    for (int tick = 0; tick < 5000; ++tick)
    {
        const Vector3 requested(wall.force_at(hand.position), 0, 0);
        const Vector3 force = controller.control(hand.state(), requested, dt);
        EXPECT_NEAR(controller.energy(), std::max(0.0, controller.energy()), 1e-6);
        EXPECT_NEAR((force - requested).norm(), 0, 0.02);
        hand.move(force.x(), dt);
    }
    EXPECT_NEAR(hand.position, -1.0 / 500, 1e-6);
}

TEST(Passivity, AddsTheDampingThatTakesTheSurplusOutInOneTick)
{
    PassivityController controller(5);
    controller.control(state_at(0), Vector3(1, 0, 0), dt);
    const Vector3 force = controller.control(state_at(0.0001, 0.5), Vector3(1, 0, 0), dt); // 0.1 mJ out of nothing
    EXPECT_NEAR(controller.energy(), -0.0001, 1e-15);
    EXPECT_NEAR(controller.damping(), 0.0001 / (0.25 * dt), 1e-12);
    EXPECT_NEAR(force.x(), 1 - 0.4 * 0.5, 1e-12);
    controller.control(state_at(0.0001 + 0.5 * dt, 0.5), Vector3(0, 0, 0), dt);
    EXPECT_NEAR(controller.energy(), -0.0001 + 0.0001 - 1 * 0.5 * dt,
                1e-12); // the work of the requested force remains
}

TEST(Passivity, DampsNoMoreThanItMay)
{
    PassivityController controller(5);
    controller.control(state_at(0), Vector3(1, 0, 0), dt);
    controller.control(state_at(0.01, 0.1), Vector3(1, 0, 0), dt);
    EXPECT_EQ(controller.damping(), 5);
    controller.control(state_at(0.01, 0), Vector3(1, 0, 0), dt); // at rest nothing can be damped
    EXPECT_EQ(controller.damping(), 0);
}

TEST(Passivity, ACreditEndsWithTheTouchADebtDoesNot)
{
    PassivityController controller(0);
    controller.control(state_at(0), Vector3(2, 0, 0), dt);
    controller.control(state_at(-0.01), Vector3::Zero(), dt);
    EXPECT_EQ(controller.energy(), 0);
    controller.control(state_at(-0.01), Vector3(2, 0, 0), dt);
    controller.control(state_at(0), Vector3::Zero(), dt);
    EXPECT_NEAR(controller.energy(), -0.02, 1e-15);
    controller.control(state_at(0), Vector3::Zero(), dt);
    EXPECT_NEAR(controller.energy(), -0.02, 1e-15);
    controller.reset();
    EXPECT_EQ(controller.energy(), 0);
}

TEST(Passivity, ForgetsTheForcesOfBeforeARestart)
{
    PassivityController controller(5);
    controller.set_delay(5);
    for (int tick = 0; tick < 10; ++tick)
        controller.control(state_at(0), Vector3(2, 0, 0), dt);
    controller.reset();
    for (int tick = 0; tick < 10; ++tick)
    {
        controller.control(state_at(0.001 * tick, 1), Vector3::Zero(), dt);
        EXPECT_EQ(controller.energy(), 0) << tick;
    }
}

struct LateWall
{
    double swing_at_first, swing_in_the_end; // m; of one second each
    double least_energy;                     // J

    explicit LateWall(double max_damping)
    {
        PassivityController controller(max_damping);
        SimulatedHand hand;
        hand.damping = 0.2;
        hand.push = -2;
        hand.position = 0.005;
        SimulatedWall wall(800, 4);
        Swing first, last;
        least_energy = 0;
        for (int tick = 0; tick < 10000; ++tick)
        {
            const Vector3 requested(wall.force_at(hand.position), 0, 0);
            hand.move(controller.control(hand.state(), requested, dt).x(), dt);
            least_energy = std::min(least_energy, controller.energy());
            if (tick < 1000)
                first.add(hand.position);
            if (tick >= 9000)
                last.add(hand.position);
        }
        swing_at_first = first.width();
        swing_in_the_end = last.width();
    }
};

TEST(Passivity, BoundsTheEnergyOfAWallThatAnswersLate)
{
    const LateWall observed(0), controlled(10);
    EXPECT_GT(observed.swing_in_the_end, 2 * observed.swing_at_first);
    EXPECT_LT(observed.least_energy, -1);
    EXPECT_LT(controlled.swing_in_the_end, 0.5 * controlled.swing_at_first);
    EXPECT_GT(controlled.least_energy, -0.01);
}

/// A force of one tick and a motion of one tick: the motion is charged only to the force that acted `delay` ticks before.
TEST(Passivity, AMotionIsPaidByTheForceOfTheDelayBefore)
{
    for (const auto &[ticks, delay] : {std::pair(0.0, 0), std::pair(1.0, 1), std::pair(1.6, 2), std::pair(5.4, 5),
                                       std::pair(1000.0, PassivityController::most_delay)})
    {
        for (int moved_after = 1; moved_after < 70; ++moved_after)
        {
            PassivityController controller(0);
            controller.set_delay(ticks);
            controller.control(state_at(0), Vector3(2, 0, 0), dt);
            for (int tick = 1; tick < moved_after; ++tick)
                controller.control(state_at(0), Vector3::Zero(), dt);
            controller.control(state_at(0.01), Vector3::Zero(), dt);
            EXPECT_NEAR(controller.energy(), moved_after == delay + 1 ? -0.02 : 0, 1e-15)
                << delay << ", " << moved_after;
        }
    }
}

TEST(Passivity, ForgetsWhatIsNotANumber)
{
    PassivityController controller(5);
    controller.control(state_at(0), Vector3(1, 0, 0), dt);
    EXPECT_FALSE(controller.control(state_at(nan, nan), Vector3(nan, 0, 0), dt).allFinite());
    controller.written(Vector3::Zero());
    controller.control(state_at(0), Vector3(1, 0, 0), dt);
    EXPECT_EQ(controller.energy(), 0);
    EXPECT_TRUE(controller.control(state_at(0, 0.1), Vector3(1, 0, 0), dt).allFinite());
}

TEST(Passivity, RefusesADampingThatCannotBe)
{
    for (const double bad : {-1.0, nan, infinity})
        EXPECT_THROW(PassivityController{bad}, std::invalid_argument);
}
} // namespace
} // namespace ode_predictive_space::haptics
