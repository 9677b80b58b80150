// The forecast of a contact counts all that the objects may move and turn within their predictions.

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/near/contact_forecast.h"
#include "ode_predictive_space/surface/triangle_tree.h"
#include "tests/shape/random_shapes.h"

namespace ode_predictive_space
{
namespace
{
constexpr double for_long = 1000; // ticks

ConvexShape ball(const Vector3 &centre)
{
    ConvexShape shape;
    shape.kind = ShapeKind::rounded;
    shape.radius = 1;
    shape.size = 2;
    shape.group = shape.partners = 1;
    shape.axes = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
    shape.centre = centre;
    return shape;
}

Envelope going(const ConvexShape &shape, const Vector3 &velocity)
{
    Envelope envelope;
    envelope.path = {shape.centre, velocity, Vector3::Zero()};
    envelope.radius = shape.radius + shape.half_sides.norm();
    return envelope;
}

// Once, the deviation was taken along an axis of the scene: two objects touched while the forecast kept them apart.
TEST(ContactForecast, DeviationsAreThoseOfEachCoordinateAlongADiagonal)
{
    const double root = std::sqrt(3);
    const ConvexShape left = ball({0, 0, 0}), right = ball(Vector3::Constant(12 / root));
    const PredictedShape still{left, going(left, Vector3::Zero()), true, true};
    PredictedShape comes{right, going(right, Vector3::Constant(-0.5 / root)), false, true};
    comes.envelope.deviation = {1 / root, 0.3 / root, 0};
    EXPECT_NEAR(time_of_contact(still, comes, 0, for_long).value(), 10, 1e-6);
}

// 10 apart, at 2 per tick, braked by 0.16 per tick: 10 - 2 t + 0.08 t^2 = 0.
TEST(ContactForecast, OfBallsThatSpeedUpOrBrakeIsThatOfTheirPaths)
{
    const ConvexShape left = ball({0, 0, 0}), right = ball({12, 0, 0});
    const PredictedShape still{left, going(left, Vector3::Zero()), true, true};
    PredictedShape comes{right, going(right, {-2, 0, 0}), false, true};
    comes.envelope.path.acceleration = {0.16, 0, 0};
    EXPECT_NEAR(time_of_contact(still, comes, 0, for_long).value(), (2 - std::sqrt(0.8)) / 0.16, 1e-6);
    comes.envelope.path.acceleration = {-0.16, 0, 0};
    EXPECT_NEAR(time_of_contact(comes, still, 0, for_long).value(), (std::sqrt(7.2) - 2) / 0.16, 1e-6);
}

TEST(ContactForecast, WhatMayTurnReachesAsFarAsItsSphere)
{
    ConvexShape stick = ball({10, 0, 0});
    stick.half_sides = {0, 0, 4};
    const ConvexShape other = ball({0, 0, 0});
    const PredictedShape still{other, going(other, Vector3::Zero()), true, true};
    PredictedShape comes{stick, going(stick, {-0.5, 0, 0}), false, true};
    EXPECT_NEAR(time_of_contact(still, comes, 0, for_long).value(), 8, 1e-6) << "8 - 4, at 0.5";
    comes.about_centre = false;
    EXPECT_EQ(time_of_contact(still, comes, 0, for_long), 1) << "it may turn about any point";
    ConvexShape wedge = hull_of({{-2, -2, 0}, {2, -2, 0}, {-2, 2, 0}});
    wedge.centre = {7, 7, 0};
    const PredictedShape tip_first{wedge, going(wedge, -0.5 * Vector3(1, 1, 0).normalized()), false, true};
    const double until = 2 * (5 * std::sqrt(2.0) - 1);
    EXPECT_NEAR(time_of_contact(still, tip_first, 0, for_long).value(), until, 1e-6) << "its tip is its farthest point";
    EXPECT_NEAR(time_of_contact(tip_first, still, 0, for_long).value(), until, 1e-6);
}

// Two triangles, 10 apart, as one mesh: the room between them is within its hull. The floor's normal points up.
struct Room
{
    Room()
    {
        const auto tree = std::make_shared<TriangleTree>(
            TriangleArrays{points.data(), sizeof(Vector3), 6, triangles.data(), 2, sizeof triangles[0], false});
        tree->build(1000);
        mesh = hull_of(points, tree);
        mesh.group = mesh.partners = 1;
    }

    const std::vector<Vector3> points = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}, {-9, -9, 10}, {9, -9, 10}, {0, 9, 10}};
    const std::vector<TriangleArrays::Indices> triangles = {{0, 1, 2}, {3, 4, 5}};
    ConvexShape mesh;
};

TEST(ContactForecast, WithinTheHullOfAMeshIsThatOfItsTriangles)
{
    const Room of_two;
    const ConvexShape &mesh = of_two.mesh;
    ConvexShape inside = ball({0, -2, 4});
    const PredictedShape room{mesh, going(mesh, Vector3::Zero()), true, true};
    PredictedShape falls{inside, going(inside, {0, 0, -0.1}), false, true};
    const double foretold = time_of_contact(room, falls, 0, for_long).value();
    EXPECT_LE(foretold, 30);
    EXPECT_GE(foretold, 20) << "a gap is only bounded";
    EXPECT_EQ(time_of_contact(falls, room, 0, for_long), foretold);
    EXPECT_FALSE(time_of_contact(room, falls, 0, 19));
    const double gap = 0.1 * foretold, diagonal = std::sqrt(3.0);
    falls.envelope.deviation = {0.1, 0.05, 0};
    EXPECT_NEAR(time_of_contact(room, falls, 0, for_long).value(), (gap - 0.2 * diagonal) / (0.1 + 0.05 * diagonal),
                1e-6);
    falls.envelope.deviation = {0, 0, 0.01};
    falls.envelope.path.acceleration = {0, 0, -0.02};
    const double sooner = time_of_contact(room, falls, 0, for_long).value();
    EXPECT_NEAR(0.1 * sooner + (0.01 + 0.01 * diagonal) * sooner * sooner, gap, 1e-6);
    EXPECT_EQ(time_of_contact({mesh, going(mesh, Vector3::Zero()), false, true}, falls, 0, for_long), 1)
        << "a room that moves";
    const ConvexShape touching = ball({0, -2, 0.5});
    EXPECT_EQ(time_of_contact(room, {touching, going(touching, Vector3::Zero()), false, true}, 0, for_long), 0);
}

TEST(ContactForecast, WithinTheHullOfAMeshWhatMayTurnReachesAsFarAsItsSphere)
{
    const Room of_two;
    ConvexShape stick = ball({0, -2, 5});
    stick.half_sides = {1, 0, 0};
    const PredictedShape room{of_two.mesh, going(of_two.mesh, Vector3::Zero()), true, true};
    PredictedShape falls{stick, going(stick, {0, 0, -0.1}), false, true, false};
    const double foretold = time_of_contact(room, falls, 0, for_long).value();
    falls.turns = true;
    EXPECT_NEAR(time_of_contact(room, falls, 0, for_long).value(), foretold - 10, 1e-6) << "2 - 1, at 0.1";
    falls.about_centre = false;
    EXPECT_EQ(time_of_contact(room, falls, 0, for_long), 1) << "it may turn about any point";
}
} // namespace
} // namespace ode_predictive_space
