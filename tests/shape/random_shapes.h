// Random shapes of all kinds, and their distance by another method than the gap: by nearest points.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SHAPE_RANDOM_SHAPES_H
#define ODE_PREDICTIVE_SPACE_TESTS_SHAPE_RANDOM_SHAPES_H

#include <array>
#include <memory>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"
#include "ode_predictive_space/surface/triangle_tree.h"

namespace ode_predictive_space
{
enum class SolidKind
{
    sphere,
    box,
    capsule,
    cylinder,
    hull,
    plane
};
constexpr std::array<SolidKind, 6> solids{SolidKind::sphere,   SolidKind::box,  SolidKind::capsule,
                                          SolidKind::cylinder, SolidKind::hull, SolidKind::plane};

class ShapeMaker
{
public:
    explicit ShapeMaker(unsigned seed) : random_(seed) {}

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    bool one_in(int count) { return random_() % static_cast<unsigned>(count) == 0; }
    Vector3 vector() { return Vector3(between(-1, 1), between(-1, 1), between(-1, 1)); }
    Vector3 direction();
    /// Any rotation, often exactly or nearly along the axes of the scene.
    Eigen::Matrix3d rotation();

    /// A shape with sides from 0.02 to 1, at the origin.
    ConvexShape shape(SolidKind solid);

private:
    ConvexShape hull();

    std::mt19937_64 random_;
};

/// The hull of points in their place; for a mesh, with its triangles.
ConvexShape hull_of(const std::vector<Vector3> &points, const std::shared_ptr<TriangleTree> &surface = nullptr);

ConvexShape moved(const ConvexShape &shape, const Eigen::Matrix3d &turn, const Vector3 &by);

/// A distance between two points of the shapes: never less than the distance of the shapes, and close to it after many steps.
double distance_from_above(const ConvexShape &first, const ConvexShape &second, int steps);
} // namespace ode_predictive_space

#endif
