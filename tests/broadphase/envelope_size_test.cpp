// How large are the envelopes that the predictor makes: their boxes, and what their deviations grow to?

#include "ode_predictive_space/broadphase/predict/predictor.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/tracked.h"

namespace ode_predictive_space
{
namespace
{
constexpr double tick_length = 0.001;

// A rod that is carried by a body and tumbles about a point that is not its middle. Of its class no sphere is known.
struct TumblingRod
{
    Vector3 half = Vector3(0.3, 0.05, 0.05), middle = Vector3(0.1, 0, 0);
    Vector3 position = Vector3(1, 2, 3), velocity = Vector3(0.5, 0.2, 0);
    Vector3 axis = Vector3(1, 2, -1).normalized();
    double spin = 5, angle = 0;

    Observation next()
    {
        position += tick_length * velocity;
        angle += tick_length * spin;
        return seen();
    }

    Observation seen() const
    {
        const Eigen::Matrix3d turned = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
        const Vector3 centre = position + turned * middle, reach = turned.cwiseAbs() * half;
        Observation seen = seen_bounds(Box(centre - reach, centre + reach));
        seen.centre = position;
        seen.velocity = velocity;
        seen.spin = spin;
        return seen;
    }

    double farthest_point() const { return (half + middle.cwiseAbs()).norm(); }
};

class EnvelopeSize : public testing::Test
{
protected:
    void follow(int ticks)
    {
        for (int tick = 0; tick < ticks; ++tick)
            tracked.see(rod.next());
    }

    double highest_side() const
    {
        return std::max({tracked.record().prediction.high[0], tracked.record().prediction.high[1],
                         tracked.record().prediction.high[2]});
    }

    // Predicted by its bounding box as it is now?
    bool has_its_own_box(const Observation &seen) const
    {
        const double side = (seen.bounds->max() - tracked.path().path().position).maxCoeff();
        return std::abs(highest_side() - side) < 1e-6;
    }

    Predictor predictor;
    Tracked tracked{predictor};
    TumblingRod rod;
};

TEST_F(EnvelopeSize, WhatTumblesStaysInTheCubeAroundItsPivot)
{
    follow(500);
    EXPECT_EQ(tracked.record().kind.check, Check::bounds);
    const int predictions = tracked.predictions, violations = tracked.violations;
    follow(5000);
    EXPECT_EQ(tracked.violations, violations);
    EXPECT_LT(tracked.predictions - predictions, 5000 / 50);
}

// The corners of a rod's bounding box are farther away than the rod is, more or less as it is turned.
TEST_F(EnvelopeSize, TheSmallestSuchCubeIsKept)
{
    follow(10); // how far it turns in a tick is not known at first
    for (int i = 0; i < 300; ++i)
    {
        const double last = highest_side();
        tracked.predict(rod.next());
        ASSERT_LE(highest_side(), last) << i;
        ASSERT_GE(highest_side(), rod.farthest_point()) << i;
    }
    EXPECT_LT(highest_side(), 1.1 * rod.farthest_point());
}

TEST_F(EnvelopeSize, ACubeThatWasLeftIsForgotten)
{
    follow(500);
    rod.half *= 2;
    follow(500);
    EXPECT_GE(highest_side(), rod.farthest_point());
    const int violations = tracked.violations;
    follow(2000);
    EXPECT_EQ(tracked.violations, violations);
}

TEST_F(EnvelopeSize, WhatHardlyTurnsHasItsOwnBox)
{
    rod.spin = 0.1;
    follow(500);
    tracked.predict(rod.next());
    EXPECT_TRUE(has_its_own_box(rod.seen()));
}

TEST_F(EnvelopeSize, TightBoundsLastUnlessItTurnsFast)
{
    follow(200);
    for (const double spin : {0.0, 0.1, 10.0, std::numeric_limits<double>::quiet_NaN()})
    {
        rod.spin = spin;
        Observation seen = rod.next();
        rod.angle = 0; // it is not a number after the last one
        tracked.predict(seen);
        EXPECT_EQ(tracked.record().kind.tight_bounds_last, spin < 1) << spin;
        seen.is_sphere = true;
        tracked.predict(seen);
        EXPECT_FALSE(tracked.record().kind.tight_bounds_last) << "a ball's are no tighter";
    }
}

// If its pivot is not known, nothing is known about where it will be when it has turned.
TEST_F(EnvelopeSize, WhatTurnsAroundAnUnknownPointHasItsOwnBox)
{
    follow(500);
    Observation seen = rod.next();
    seen.centre.reset();
    tracked.predict(seen);
    EXPECT_TRUE(has_its_own_box(seen));
}

// The object asked for tight bounds and began to turn: its next prediction will be by its sphere, which is smaller than the cube.
TEST_F(EnvelopeSize, WhatHasASphereNeedsNoCube)
{
    follow(500);
    Observation seen = rod.next();
    seen.radius = rod.farthest_point();
    tracked.predict(seen);
    EXPECT_TRUE(has_its_own_box(seen));
    EXPECT_FALSE(tracked.record().kind.tight_bounds_last);
}

TEST_F(EnvelopeSize, InfiniteBoundsThatTurnKeepTheirFiniteSide)
{
    follow(500);
    Observation seen = rod.next();
    seen.bounds = Box(Vector3::Constant(-infinity), Vector3(infinity, infinity, rod.position.z() + 1));
    tracked.predict(seen);
    EXPECT_NEAR(tracked.record().prediction.high[2], 1, 1e-5);
}

// Thrown about by encounters. Between two of them its path is exact.
class Bouncing : public testing::Test
{
protected:
    static constexpr double radius = 0.1;

    void fly(int flights)
    {
        for (int flight = 0; flight < flights; ++flight)
        {
            velocity_ = 0.5 * random_.vector(1).normalized();
            for (std::size_t ticks = 50 + random_.index(300); ticks > 0; --ticks)
            {
                centre_ += tick_length * velocity_;
                tracked.see(seen_ball(centre_, radius, velocity_));
                widest = std::max(widest, growth());
            }
        }
    }

    // Of the deviation until the prediction ends, in sizes.
    double growth() const
    {
        const auto ticks = static_cast<float>(ticks_between(tracked.path().since, tracked.record().prediction.until));
        return tracked.record().kind.still ? 0 : (tracked.path().reach(ticks) - tracked.path().reach(0)) / radius;
    }

    Predictor predictor;
    Tracked tracked{predictor};
    double widest = 0;

private:
    Random random_{7};
    Vector3 centre_ = Vector3::Zero(), velocity_ = Vector3::Zero();
};

TEST_F(Bouncing, NoDeviationGrowsAsWideAsTheObject)
{
    fly(300);
    EXPECT_LT(widest, 0.5);
}

TEST_F(Bouncing, WhatBreaksAPathAtOnceDoesNotLoosenTheNext)
{
    fly(300);
    double sum = 0;
    constexpr int flights = 100;
    for (int flight = 0; flight < flights; ++flight)
    {
        fly(1);
        sum += growth();
    }
    EXPECT_LT(sum / flights, 0.2);
}
} // namespace
} // namespace ode_predictive_space
