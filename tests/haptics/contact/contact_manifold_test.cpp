#include "ode_predictive_space/haptics/contact/contact_manifold.h"

#include "tests/haptics/support/constants.h"

#include <cmath>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
/// Ticks of a tool that rests at the origin, deep in the touched objects.
class ContactManifoldTest : public testing::Test
{
protected:
    static Touch touch_of(std::uintptr_t object, double depth)
    {
        Touch touch;
        touch.object = object;
        touch.depth = depth;
        return touch;
    }

    /// Two touches from nearly opposite sides. The bodies are light, if told, and answer after a time (s).
    static std::vector<Touch> opposed(bool light, double response_time = 0)
    {
        std::vector<Touch> touches = {touch_of(1, 1e-5), touch_of(2, 1e-5)};
        touches[0].normal = Vector3(std::cos(0.02), 0, std::sin(0.02));
        touches[1].normal = Vector3(-std::cos(0.02), 0, std::sin(0.02));
        for (Touch &touch : touches)
        {
            if (!light)
                continue;
            touch.mobility = 200;
            touch.material = Material();
            touch.response_time = response_time;
        }
        return touches;
    }

    std::vector<Touch> tick(std::vector<Touch> touches)
    {
        manifold_.follow(tool_, TouchView::all_together, dt, dt, touches);
        return touches;
    }

    ToolState tool_;
    ContactManifold manifold_;
};

// Once, the new touch was rendered in full immediately, so that the force jumped.
TEST_F(ContactManifoldTest, WhatTheToolGoesOnToFromWhatRisesRisesOn)
{
    tick({touch_of(1, 0.01)});
    const Touch before = tick({touch_of(1, 0.01)})[0];
    const Touch after = tick({touch_of(2, 0.01)})[0];
    EXPECT_EQ(after.takes_over, before.id);
    EXPECT_GT(after.part, before.part);
    EXPECT_LT(after.part, 0.01);
}

// Once, a ball that took over from faster ones counted as an object that had appeared: half a second passed without its force.
TEST_F(ContactManifoldTest, WhatTakesOverFromFasterOnesIsThereAtOnce)
{
    const auto moving = [](std::uintptr_t object, double share, double speed) {
        Touch touch = touch_of(object, share);
        touch.carry.share = share;
        touch.is_solved = true;
        touch.surface_velocity.z() = speed;
        return touch;
    };
    tick({moving(1, 1e-5, -0.3)});
    tick({moving(1, 0.002, -0.3)});
    EXPECT_EQ(tick({moving(2, 0.0029, 0)})[0].part, 1) << "no more than three times the way of the former";
    EXPECT_EQ(tick({moving(3, 0.004, 0)})[0].part, 0) << "the former did not move, and it is deeper";
}

// When bodies yield, the next touches have large shares immediately. Once, these counted as having appeared: the force fell.
TEST_F(ContactManifoldTest, WhatTakesOverFromSeveralOthersIsThereAtOnce)
{
    const auto solved = [](std::uintptr_t object, double slant, double share) {
        Touch touch = touch_of(object, share);
        touch.normal = {std::sin(slant), 0, std::cos(slant)};
        touch.carry.share = share;
        touch.is_solved = true;
        return touch;
    };
    tick({solved(1, 0, 1e-5)});
    tick({solved(1, 0, 0.002)});
    const double slant = 80 * M_PI / 180, share = 0.001 / std::cos(slant);
    for (const Touch &touch : tick({solved(2, slant, share), solved(3, -slant, share)}))
        EXPECT_EQ(touch.part, 1) << "the lift is the same";
    for (const Touch &touch : tick({solved(4, slant / 2, share), solved(5, -slant / 2, share)}))
        EXPECT_EQ(touch.part, 0) << "the lift is another";
}
// Two light bodies touch from nearly opposite sides, for which the exact shares are 1,250 times the depth.
TEST_F(ContactManifoldTest, WhatAPushMovesYieldsToWhatIsOpposite)
{
    const std::vector<Touch> heavy = tick(opposed(false));
    EXPECT_GT(heavy[0].carry.share, 1000 * 1e-5);
    const std::vector<Touch> light = tick(opposed(true));
    for (const Touch &touch : light)
    {
        EXPECT_GT(touch.carry.share, 0);
        EXPECT_LT(touch.carry.share, 20 * 1e-5);
    }
}

// Once, a body that moves only with the scene's next step yielded as if it moved within the tick: contacts were too stiff.
TEST_F(ContactManifoldTest, ABodyThatAnswersLateYieldsByTheTimeThatItTakes)
{
    const double soon = tick(opposed(true))[0].carry.share;
    const double late = tick(opposed(true, 5 * dt))[0].carry.share;
    EXPECT_LT(late, soon / 3);
    EXPECT_GT(late, 0);
}

TEST_F(ContactManifoldTest, TouchesOfOneObjectInOnePlaneKeepTheirIds)
{
    Touch touch = touch_of(1, 1e-5);
    touch.from_entry_side = true;
    const std::vector<Touch> before = tick({touch, touch}), after = tick({touch, touch});
    EXPECT_NE(before[0].id, before[1].id);
    for (const int i : {0, 1})
        EXPECT_EQ(after[i].id, before[i].id);
}
} // namespace
} // namespace ode_predictive_space::haptics
