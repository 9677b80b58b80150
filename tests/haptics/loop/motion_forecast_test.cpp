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

TEST_F(MotionForecastTest, MotionIsLinearBetweenTheNodesAndBeyondTheLast)
{
    const Impulse push = {1, Vector3::Zero(), Vector3(-4, 0, 0), 1, 1};
    for (const double nodes : {0.5, 1.5, 3.5})
    {
        const Shift shift = shift_at(1 + nodes * node, {push});
        const double falls = nodes < 1 ? 0.001 : 0.003; // m; between the nodes around
        EXPECT_NEAR(shift.moved.x(), 2 * nodes * node, 1e-12);
        EXPECT_NEAR(shift.velocity.x(), 2, 1e-12);
        EXPECT_NEAR(shift.moved.z(), nodes < 1 ? nodes * falls : 0.001 + (nodes - 1) * falls, 1e-12);
        EXPECT_NEAR(shift.velocity.z(), falls / node, 1e-12);
    }
}

TEST_F(MotionForecastTest, APushMovesOtherBodiesByTheirResponseToIt)
{
    MotionForecast::Place &other = forecast_->places[1] = forecast_->places[0];
    other.touch.object = 2;
    forecast_->count = 2;
    forecast_->response[0][1] = forecast_->response[0][0];
    forecast_->response[1].fill(forecast_->response[0][0]);
    for (MotionForecast::Response &response : forecast_->response[0][1])
        response *= 0.5;
    const Impulse push = {1, Vector3::Zero(), Vector3(-4, 0, 0), 1, 1};
    EXPECT_NEAR(shift_of(2, forecast_->shifts({push}, 1 + node)).moved.x(), node, 1e-12);
}
} // namespace
} // namespace ode_predictive_space::haptics
