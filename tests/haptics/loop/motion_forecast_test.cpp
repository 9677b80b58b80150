#include "ode_predictive_space/haptics/loop/motion_forecast.h"

#include <gtest/gtest.h>
#include <memory>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double node = 0.01; // s

/// A body of 2 kg that pushes do not turn, touched at one place.
class MotionForecastTest : public testing::Test
{
protected:
    MotionForecastTest()
    {
        Touch touch;
        touch.object = 1;
        touch.normal = -Vector3::UnitX();
        MotionForecast::Place &place = forecast_->places[0];
        place.touch = touch;
        place.velocity << 0.5, 0, 0, 0, 0, 0;
        MotionForecast::Response pushes = MotionForecast::Response::Zero();
        pushes.topLeftCorner<3, 3>().setIdentity();
        place.combination = pushes.transpose();
        forecast_->time = 1;
        forecast_->node_length = node;
        forecast_->count = 1;
        for (int i = 0; i <= 2; ++i)
        {
            place.free[i] << 0.5 * node * i, 0, 0.001 * i * i, 0, 0, 0;
            forecast_->response[0][0][i] = pushes * (node * i / 2.0);
        }
    }

    Shift shift_at(double time, const std::vector<Impulse> &impulses = {})
    {
        return shift_of(1, forecast_->shifts(impulses, time));
    }

    std::unique_ptr<MotionForecast> forecast_ = std::make_unique<MotionForecast>();
};

TEST_F(MotionForecastTest, ImpulsesThatTheSceneHasGotAndThoseOfOthersAreLeftOut)
{
    const Impulse old = {1, Vector3::Zero(), Vector3(-4, 0, 0), 1, 7};
    const Impulse other = {2, Vector3::Zero(), Vector3(-4, 0, 0), 1, 8};
    forecast_->last_included = 7;
    EXPECT_LE((shift_at(1 + node, {old, other}).moved - shift_at(1 + node).moved).norm(), 1e-15);
}
} // namespace
} // namespace ode_predictive_space::haptics
