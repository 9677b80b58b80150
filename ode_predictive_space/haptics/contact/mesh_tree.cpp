#include "ode_predictive_space/haptics/contact/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double nearer = 1 - 1e-12;    // of a squared distance; below it, a place counts as nearer
constexpr std::uint32_t large_fan = 12; // triangles at a corner
constexpr int no_minimum = -2;          // instead of a triangle
constexpr double same_place = 1e-7;     // of the distance
constexpr double far = 2;               // radii of a node; from there, it is a dipole

/// Formula of van Oosterom and Strackee (1983).
double solid_angle(const TriangleCorners &corners, const Vector3 &point)
{
    const Vector3 a = corners[0] - point, b = corners[1] - point, c = corners[2] - point;
    const double al = a.norm(), bl = b.norm(), cl = c.norm();
    return 2 * std::atan2(a.dot(b.cross(c)), al * bl * cl + a.dot(b) * cl + b.dot(c) * al + c.dot(a) * bl);
}

SurfaceFeature feature_of(const NearestOnTriangle &nearest, std::size_t triangle, const Vector3 &point)
{
    SurfaceFeature feature;
    feature.point = nearest.point;
    feature.distance = std::sqrt(nearest.squared_distance);
    feature.triangle = static_cast<int>(triangle);
    if (feature.distance > 0)
        feature.normal = (point - nearest.point) / feature.distance;
    return feature;
}
} // namespace

MeshTree::MeshTree(const std::vector<TriangleCorners> &triangles) : MeshTree(Unread(), triangles.size())
{
    for (const TriangleCorners &corners : triangles)
        add(corners);
    build(std::numeric_limits<std::size_t>::max());
}

MeshTree::MeshTree(Unread, std::size_t count) : count_(count), known_(std::make_unique<VertexTable>())
{
    vertices_.reserve(count);
    triangles_.reserve(count);
    fans_.reserve(count);
    fan_next_.reserve(3 * count);
    finite_.reserve(count);
}

// Corners at the same place become one vertex, whatever the indices of the mesh. Triangles that are not finite are left out.
void MeshTree::add(const TriangleCorners &corners)
{
    TriangleArrays::Indices triangle;
    for (int i = 0; i < 3; ++i)
    {
        triangle[i] = known_->number_of(corners[i] + Vector3::Zero(), vertices_); // -0 is 0
        fans_.resize(vertices_.size());
        Fan &fan = fans_[triangle[i]];
        fan_next_.push_back(std::exchange(fan.first, static_cast<std::uint32_t>(fan_next_.size())));
        ++fan.size;
    }
    if (corners[0].allFinite() && corners[1].allFinite() && corners[2].allFinite())
        finite_.push_back(static_cast<std::uint32_t>(triangles_.size()));
    triangles_.push_back(triangle);
}

std::size_t MeshTree::build(std::size_t steps)
{
    if (!tree_)
        begin_tree();
    steps = tree_->build(steps);
    if (!tree_->is_ready())
        return steps;
    if (dipoles_.empty())
        dipoles_.reserve(tree_->nodes().size());
    for (; steps > 0 && !is_ready(); --steps)
        add_dipole();
    return steps;
}

void MeshTree::begin_tree()
{
    known_.reset();
    const TriangleArrays arrays = {vertices_.data(),
                                   sizeof(Vector3),
                                   static_cast<unsigned>(vertices_.size()),
                                   triangles_.data(),
                                   static_cast<unsigned>(triangles_.size()),
                                   sizeof(TriangleArrays::Indices),
                                   false};
    tree_.emplace(arrays, std::move(finite_));
}

double MeshTree::collect(const Vector3 &point, double radius, SurfaceFeatures &features, Budget *budget) const
{
    const std::size_t first = features.size();
    double nearest = radius;
    const auto is_near = [&](std::uint32_t node) {
        return (budget == nullptr || !budget->is_exceeded()) &&
               tree_->nodes()[node].squared_distance(point) <= radius * radius;
    };
    tree_->descend(is_near, [&](std::uint32_t triangle) {
        if (budget == nullptr || budget->take())
            nearest = std::min(nearest, add(point, triangle, radius, first, features));
    });
    const auto is_none = [](const SurfaceFeature &feature) { return feature.triangle == no_minimum; };
    const auto begin = features.begin() + static_cast<std::ptrdiff_t>(first);
    features.erase(std::remove_if(begin, features.end(), is_none), features.end());
    return nearest;
}

double MeshTree::distance(const Vector3 &point, double most) const
{
    tree_->walk(point, most, [&](std::uint32_t triangle) {
        const double squared = nearest_on_triangle(point, corners(triangle)).squared_distance;
        most = squared < most * most ? std::sqrt(squared) : most;
        return true;
    });
    return most;
}

/// Adds the dipole of the last node without one: children precede their parents.
void MeshTree::add_dipole()
{
    const TriangleTree::Node &node = tree_->nodes()[tree_->nodes().size() - 1 - dipoles_.size()];
    const Vector3 low = node.low.cast<double>(), high = node.high.cast<double>();
    Dipole dipole = sum_of(node);
    dipole.centre = dipole.size > 0 ? Vector3(dipole.centre / dipole.size) : Vector3((low + high) / 2);
    dipole.radius = (low - dipole.centre).cwiseAbs().cwiseMax((high - dipole.centre).cwiseAbs()).norm();
    dipoles_.push_back(dipole);
}

/// Sums the triangles of a leaf or the children of a node; centres are weighted by area.
MeshTree::Dipole MeshTree::sum_of(const TriangleTree::Node &node) const
{
    Dipole sum;
    const auto add = [&](const Vector3 &area, double size, const Vector3 &centre) {
        sum.area += area;
        sum.size += size;
        sum.centre += size * centre;
    };
    if (!node.is_leaf())
        for (const Dipole *child : {&dipole_of(node.first), &dipole_of(node.first + 1)})
            add(child->area, child->size, child->centre);
    for (std::uint32_t i = node.first; i < node.end; ++i)
    {
        const TriangleCorners at = corners(tree_->order()[i]);
        const Vector3 area = 0.5 * (at[1] - at[0]).cross(at[2] - at[0]);
        add(area, area.norm(), (at[0] + at[1] + at[2]) / 3);
    }
    return sum;
}

double MeshTree::winding_number(const Vector3 &point) const
{
    double angle = 0;
    const auto is_near = [&](std::uint32_t node) {
        const Dipole &dipole = dipole_of(node);
        const Vector3 way = dipole.centre - point;
        const double distance = way.norm();
        if (!(distance > far * dipole.radius))
            return true;
        angle += dipole.area.dot(way) / (distance * distance * distance);
        return false;
    };
    tree_->descend(is_near, [&](std::uint32_t triangle) { angle += solid_angle(corners(triangle), point); });
    return angle / (4 * EIGEN_PI);
}

SurfaceFeature MeshTree::nearest_of(std::size_t triangle, const Vector3 &point) const
{
    return feature_of(nearest_on_triangle(point, corners(triangle)), triangle, point);
}

double MeshTree::add(const Vector3 &point, std::uint32_t triangle, double radius, std::size_t first,
                     SurfaceFeatures &features) const
{
    const TriangleCorners at = corners(triangle);
    const NearestOnTriangle found = nearest_on_triangle(point, at);
    if (!(found.squared_distance <= radius * radius))
        return radius;
    SurfaceFeature feature = feature_of(found, triangle, point);
    const auto same = [&](const SurfaceFeature &other) {
        return (other.point - found.point).norm() <= same_place * feature.distance;
    };
    if (std::any_of(features.begin() + static_cast<std::ptrdiff_t>(first), features.end(), same))
        return feature.distance;
    const bool is_lowest = is_minimum(found, triangle, point);
    if (!is_lowest)
        feature.triangle = no_minimum;
    const bool in_large_fan =
        found.part == TrianglePart::corner && fans_[triangles_[triangle][found.index]].size > large_fan;
    if (is_lowest || in_large_fan) // then the other triangles of the fan need no check
        features.push_back(feature);
    return feature.distance;
}

bool MeshTree::is_minimum(const NearestOnTriangle &nearest, std::uint32_t triangle, const Vector3 &point) const
{
    if (nearest.part == TrianglePart::face)
        return true;
    const TriangleArrays::Indices &vertices = triangles_[triangle];
    const std::uint32_t vertex = vertices[nearest.index];
    const std::uint32_t other = nearest.part == TrianglePart::edge ? vertices[(nearest.index + 1) % 3] : vertex;
    for (std::uint32_t at = fans_[vertex].first; at != end_of_fan; at = fan_next_[at])
    {
        const std::uint32_t neighbour = at / 3;
        const TriangleArrays::Indices &corner = triangles_[neighbour];
        if (neighbour != triangle && (corner[0] == other || corner[1] == other || corner[2] == other) &&
            nearest_on_triangle(point, corners(neighbour)).squared_distance < nearer * nearest.squared_distance)
            return false;
    }
    return true;
}
} // namespace ode_predictive_space::haptics
