#include "ode_predictive_space/haptics/pending_motion.h"

#include "tests/haptics/constants.h"

#include <functional>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int ticks_per_step = 10;
constexpr double step = ticks_per_step * dt;

/// A plane that moves along x, pushed with a force that the tests choose. The scene gets the impulses of a step at its end.
class PendingMotionTest : public testing::Test
{
protected:
    /// @param kilograms of the body. @param held whether it is; the scene says so by the yield from the third step on.
    /// @return m; how far the servo's plane is at each tick.
    std::vector<double> run(double kilograms, bool held, int ticks, const std::function<double(int)> &newtons)
    {
        std::vector<double> places;
        for (int i = 0; i < ticks; ++i)
        {
            if (i % ticks_per_step == 0)
            {
                make_model(kilograms, held && i >= 2 * ticks_per_step ? 0 : 1, i);
                advance_scene(kilograms, held);
            }
            const double now = dt * i;
            pending_.update(model_, i % ticks_per_step == 0, held_, now - dt, now);
            places.push_back(model_place_ + model_velocity_ * (now - model_time_) + pending_.shifts()[0].moved.x());
            give(now);
            held_ = {{1, Vector3::Zero(), -newtons(i) * Vector3::UnitX(), 0}};
        }
        return places;
    }

private:
    void make_model(double kilograms, double yield, int i)
    {
        Touch touch;
        touch.normal = -Vector3::UnitX();
        touch.object = 1;
        model_.set({touch}, true, Vector3::Zero(), dt * i);
        model_.mobility(0).inverse_mass = 1 / kilograms;
        model_.mobility(0).yield = yield;
        model_.set_included(included_, included_since_);
        model_place_ = place_;
        model_velocity_ = velocity_;
        model_time_ = dt * i;
    }

    /// As ODE does: velocity first.
    void advance_scene(double kilograms, bool held)
    {
        included_ = number_;
        included_since_ = model_time_;
        if (!held)
        {
            velocity_ += on_its_way_ / kilograms;
            place_ += velocity_ * step;
        }
        on_its_way_ = 0;
    }

    /// What was held since the last tick.
    void give(double now)
    {
        for (const ForceShare &share : held_)
        {
            const Vector3 impulse = -dt * share.force;
            on_its_way_ += impulse.x();
            pending_.add(1, Vector3::Zero(), impulse, now - dt, ++number_);
        }
    }

    ContactModel model_;
    PendingMotion pending_{1000};
    std::vector<ForceShare> held_;
    std::uint64_t number_ = 0;
    std::uint64_t included_ = 0;
    double included_since_ = 0;
    double place_ = 0;
    double velocity_ = 0;
    double on_its_way_ = 0; // N s
    double model_place_ = 0;
    double model_velocity_ = 0;
    double model_time_ = 0;
};

TEST_F(PendingMotionTest, AFreePlaneMovesAsTheImpulsesMoveItWithoutAnyDelay)
{
    constexpr double kilograms = 0.02;
    const auto newtons = [](int i) { return i < 60 ? 0.1 + 0.05 * (i % 7) : 0; };
    const std::vector<double> places = run(kilograms, false, 100, newtons);
    double place = 0;
    double velocity = 0;
    for (int i = 1; i < 100; ++i)
    {
        velocity += newtons(i - 1) * dt / kilograms;
        place += velocity * dt;
        // The lead fades a little: at most by what a second does in a tenth of it.
        ASSERT_NEAR(places[i], place, 0.1 * velocity * 2 * step) << i;
        ASSERT_NEAR(places[i] - places[i - 1], velocity * dt, 2e-5) << i;
    }
}

TEST_F(PendingMotionTest, AHeldPlaneComesBackWithoutAJumpWhenTheSceneSaysSo)
{
    const std::vector<double> places = run(0.02, true, 200, [](int) { return 0.2; });
    double farthest = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
    {
        farthest = std::max(farthest, places[i]);
        ASSERT_LE(std::abs(places[i] - places[i - 1]), std::max(0.06 * farthest, 3e-4)) << i;
    }
    EXPECT_GT(farthest, 1e-3) << "two steps as a free body";
    EXPECT_NEAR(places.back(), 0, 1e-5);
}

TEST_F(PendingMotionTest, GeomsWithoutABodyStay)
{
    for (const double place : run(infinity, true, 50, [](int) { return 5; }))
    {
        EXPECT_EQ(place, 0);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
