#include "ode_predictive_space/haptics/contact/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double nearer = 1 - 1e-12;    // square of a distance: so much of it counts as nearer
constexpr std::uint32_t large_fan = 12; // triangles at a corner
constexpr int no_minimum = -2;          // instead of a triangle
constexpr double same_place = 1e-7;     // of the distance
constexpr double far = 2;               // times the radius of a node: from there, it is a dipole

struct PlaceHash
{
    std::size_t operator()(const std::array<double, 3> &place) const
    {
        std::size_t hash = 0;
        for (const double coordinate : place)
            hash = hash * 1000003 ^ std::hash<double>()(coordinate);
        return hash;
    }
};

// What is not a number is nowhere.
std::vector<std::uint32_t> finite_among(const std::vector<TriangleCorners> &triangles)
{
    std::vector<std::uint32_t> finite;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
        const TriangleCorners &at = triangles[i];
        if (at[0].allFinite() && at[1].allFinite() && at[2].allFinite())
            finite.push_back(i);
    }
    return finite;
}

/// By the formula of van Oosterom and Strackee (1983).
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

MeshTree::MeshTree(const std::vector<TriangleCorners> &triangles) : tree_(weld(triangles), finite_among(triangles))
{
    list_fans();
    tree_.build(std::numeric_limits<std::size_t>::max());
    list_dipoles();
}

// Corners at the same place are one vertex, whatever the mesh's indices say.
TriangleArrays MeshTree::weld(const std::vector<TriangleCorners> &triangles)
{
    std::unordered_map<std::array<double, 3>, std::uint32_t, PlaceHash> known;
    known.reserve(triangles.size());
    triangles_.reserve(triangles.size());
    for (const TriangleCorners &corners : triangles)
    {
        TriangleArrays::Indices triangle;
        for (int i = 0; i < 3; ++i)
        {
            const std::array<double, 3> place = {corners[i].x() + 0.0, corners[i].y() + 0.0, corners[i].z() + 0.0};
            const auto [vertex, is_new] = known.emplace(place, static_cast<std::uint32_t>(vertices_.size()));
            if (is_new)
                vertices_.push_back(corners[i]);
            triangle[i] = vertex->second;
        }
        triangles_.push_back(triangle);
    }
    return {vertices_.data(),
            sizeof(Vector3),
            static_cast<unsigned>(vertices_.size()),
            triangles_.data(),
            static_cast<unsigned>(triangles_.size()),
            sizeof(TriangleArrays::Indices),
            false};
}

void MeshTree::list_fans()
{
    fan_begin_.assign(vertices_.size() + 1, 0);
    for (const TriangleArrays::Indices &triangle : triangles_)
        for (const std::uint32_t vertex : triangle)
            ++fan_begin_[vertex + 1];
    std::partial_sum(fan_begin_.begin(), fan_begin_.end(), fan_begin_.begin());
    std::vector<std::uint32_t> next(fan_begin_.begin(), fan_begin_.end() - 1);
    fans_.resize(3 * triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        for (const std::uint32_t vertex : triangles_[i])
            fans_[next[vertex]++] = i;
}

double MeshTree::collect(const Vector3 &point, double radius, SurfaceFeatures &features, Budget *budget) const
{
    const std::size_t first = features.size();
    double nearest = radius;
    const auto is_near = [&](std::uint32_t node) {
        return (budget == nullptr || !budget->is_exceeded()) &&
               tree_.nodes()[node].squared_distance(point) <= radius * radius;
    };
    tree_.descend(is_near, [&](std::uint32_t triangle) {
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
    tree_.walk(point, most, [&](std::uint32_t triangle) {
        const double squared = nearest_on_triangle(point, corners(triangle)).squared_distance;
        most = squared < most * most ? std::sqrt(squared) : most;
        return true;
    });
    return most;
}

void MeshTree::list_dipoles()
{
    dipoles_.resize(tree_.nodes().size());
    for (std::size_t index = dipoles_.size(); index-- > 0;) // children first
    {
        const TriangleTree::Node &node = tree_.nodes()[index];
        const Vector3 low = node.low.cast<double>(), high = node.high.cast<double>();
        Dipole &dipole = dipoles_[index];
        dipole = sum_of(node);
        dipole.centre = dipole.size > 0 ? Vector3(dipole.centre / dipole.size) : Vector3((low + high) / 2);
        dipole.radius = (low - dipole.centre).cwiseAbs().cwiseMax((high - dipole.centre).cwiseAbs()).norm();
    }
}

/// Of a leaf's triangles, or of a node's children: the centres times the areas, too.
MeshTree::Dipole MeshTree::sum_of(const TriangleTree::Node &node) const
{
    Dipole sum;
    const auto add = [&](const Vector3 &area, double size, const Vector3 &centre) {
        sum.area += area;
        sum.size += size;
        sum.centre += size * centre;
    };
    if (!node.is_leaf())
        for (const Dipole *child : {&dipoles_[node.first], &dipoles_[node.first + 1]})
            add(child->area, child->size, child->centre);
    for (std::uint32_t i = node.first; i < node.end; ++i)
    {
        const TriangleCorners at = corners(tree_.order()[i]);
        const Vector3 area = 0.5 * (at[1] - at[0]).cross(at[2] - at[0]);
        add(area, area.norm(), (at[0] + at[1] + at[2]) / 3);
    }
    return sum;
}

double MeshTree::winding_number(const Vector3 &point) const
{
    double angle = 0;
    const auto is_near = [&](std::uint32_t node) {
        const Dipole &dipole = dipoles_[node];
        const Vector3 way = dipole.centre - point;
        const double distance = way.norm();
        if (!(distance > far * dipole.radius))
            return true;
        angle += dipole.area.dot(way) / (distance * distance * distance);
        return false;
    };
    tree_.descend(is_near, [&](std::uint32_t triangle) { angle += solid_angle(corners(triangle), point); });
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
    const bool is_told = is_minimum(found, triangle, point);
    if (!is_told)
        feature.triangle = no_minimum;
    const bool in_large_fan =
        found.part == TrianglePart::corner && fan_size(triangles_[triangle][found.index]) > large_fan;
    if (is_told || in_large_fan) // there, so that the others of the fan need not look
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
    for (std::uint32_t i = fan_begin_[vertex]; i < fan_begin_[vertex + 1]; ++i)
    {
        const std::uint32_t neighbour = fans_[i];
        const TriangleArrays::Indices &corner = triangles_[neighbour];
        if (neighbour != triangle && (corner[0] == other || corner[1] == other || corner[2] == other) &&
            nearest_on_triangle(point, corners(neighbour)).squared_distance < nearer * nearest.squared_distance)
            return false;
    }
    return true;
}
} // namespace ode_predictive_space::haptics
