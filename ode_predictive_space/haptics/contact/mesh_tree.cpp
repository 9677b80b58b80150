#include "ode_predictive_space/haptics/contact/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::uint32_t leaf_size = 4;
constexpr int deepest = 64;             // halving 2^32 triangles takes 32
constexpr double nearer = 1 - 1e-12;    // square of a distance: so much of it counts as nearer
constexpr std::uint32_t large_fan = 12; // triangles at a corner
constexpr int no_minimum = -2;          // instead of a triangle
constexpr double same_place = 1e-7;     // of the distance
constexpr double far = 2;               // times the radius of a node: from there, it is a dipole
constexpr double pi = 3.14159265358979323846;

struct PlaceHash
{
    std::size_t operator()(const std::array<double, 3> &place) const
    {
        std::size_t hash = 0;
        for (const double coordinate : place)
        {
            hash = hash * 1000003 ^ std::hash<double>()(coordinate);
        }
        return hash;
    }
};

double squared_distance_to_box(const Vector3 &point, const Vector3 &low, const Vector3 &high)
{
    const Vector3 outside = (low - point).cwiseMax(point - high).cwiseMax(0.0);
    return outside.squaredNorm();
}

SurfaceFeature feature_of(const NearestOnTriangle &nearest, std::size_t triangle, const Vector3 &point)
{
    SurfaceFeature feature;
    feature.point = nearest.point;
    feature.distance = std::sqrt(nearest.squared_distance);
    feature.triangle = static_cast<int>(triangle);
    if (feature.distance > 0)
    {
        feature.normal = (point - nearest.point) / feature.distance;
    }
    return feature;
}
} // namespace

MeshTree::MeshTree(const std::vector<TriangleCorners> &triangles)
{
    weld(triangles);
    list_fans();
    list_order();
    if (!order_.empty())
    {
        nodes_.reserve(order_.size());
        build(0, static_cast<std::uint32_t>(order_.size()));
        list_dipoles();
    }
}

// Corners at the same place are one vertex, whatever the mesh's indices say.
void MeshTree::weld(const std::vector<TriangleCorners> &triangles)
{
    std::unordered_map<std::array<double, 3>, std::uint32_t, PlaceHash> known;
    known.reserve(triangles.size());
    triangles_.reserve(triangles.size());
    for (const TriangleCorners &corners : triangles)
    {
        Triangle triangle;
        for (int i = 0; i < 3; ++i)
        {
            const std::array<double, 3> place = {corners[i].x() + 0.0, corners[i].y() + 0.0, corners[i].z() + 0.0};
            const auto [vertex, is_new] = known.emplace(place, static_cast<std::uint32_t>(vertices_.size()));
            if (is_new)
            {
                vertices_.push_back(corners[i]);
            }
            triangle[i] = vertex->second;
        }
        triangles_.push_back(triangle);
    }
}

void MeshTree::list_fans()
{
    fan_begin_.assign(vertices_.size() + 1, 0);
    for (const Triangle &triangle : triangles_)
    {
        for (const std::uint32_t vertex : triangle)
        {
            ++fan_begin_[vertex + 1];
        }
    }
    std::partial_sum(fan_begin_.begin(), fan_begin_.end(), fan_begin_.begin());
    std::vector<std::uint32_t> next(fan_begin_.begin(), fan_begin_.end() - 1);
    fans_.resize(3 * triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    {
        for (const std::uint32_t vertex : triangles_[i])
        {
            fans_[next[vertex]++] = i;
        }
    }
}

// What is not a number is nowhere.
void MeshTree::list_order()
{
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    {
        const TriangleCorners at = corners(i);
        if (at[0].allFinite() && at[1].allFinite() && at[2].allFinite())
        {
            order_.push_back(i);
        }
    }
}

TriangleCorners MeshTree::corners(std::size_t triangle) const
{
    const Triangle &vertices = triangles_[triangle];
    return {vertices_[vertices[0]], vertices_[vertices[1]], vertices_[vertices[2]]};
}

void MeshTree::build(std::uint32_t first, std::uint32_t count)
{
    const std::size_t index = nodes_.size();
    Eigen::AlignedBox3d box;
    Eigen::AlignedBox3d centres;
    for (std::uint32_t i = first; i < first + count; ++i)
    {
        const TriangleCorners triangle = corners(order_[i]);
        for (const Vector3 &corner : triangle)
        {
            box.extend(corner);
        }
        centres.extend(triangle[0] + triangle[1] + triangle[2]);
    }
    nodes_.push_back({box.min(), box.max(), first, count});
    if (count <= leaf_size)
    {
        return;
    }
    int axis = 0;
    (centres.max() - centres.min()).maxCoeff(&axis);
    const auto centre = [&](std::uint32_t triangle) {
        const Triangle &vertices = triangles_[triangle];
        return vertices_[vertices[0]][axis] + vertices_[vertices[1]][axis] + vertices_[vertices[2]][axis];
    };
    const std::uint32_t half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                     [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
    build(first, half);
    nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[index].count = 0;
    build(first + half, count - half);
}

/// Calls visit(triangle) for each triangle that may be within the radius, which the visitor may make less.
template <typename Visit> void MeshTree::walk(const Vector3 &point, const double &radius, Visit visit) const
{
    std::array<std::uint32_t, deepest> waiting;
    int count = 0;
    if (!nodes_.empty())
    {
        waiting[count++] = 0;
    }
    while (count > 0)
    {
        const std::uint32_t index = waiting[--count];
        const Node &node = nodes_[index];
        if (!(squared_distance_to_box(point, node.low, node.high) <= radius * radius))
        {
            continue;
        }
        for (std::uint32_t i = 0; i < node.count; ++i)
        {
            visit(order_[node.first + i]);
        }
        if (node.count == 0)
        {
            waiting[count++] = node.first;
            waiting[count++] = index + 1;
        }
    }
}

double MeshTree::collect(const Vector3 &point, double radius, SurfaceFeatures &features) const
{
    const std::size_t first = features.size();
    double nearest = radius;
    walk(point, radius,
         [&](std::uint32_t triangle) { nearest = std::min(nearest, add(point, triangle, radius, first, features)); });
    const auto is_none = [](const SurfaceFeature &feature) { return feature.triangle == no_minimum; };
    const auto begin = features.begin() + static_cast<std::ptrdiff_t>(first);
    features.erase(std::remove_if(begin, features.end(), is_none), features.end());
    return nearest;
}

double MeshTree::distance(const Vector3 &point, double most) const
{
    walk(point, most, [&](std::uint32_t triangle) {
        const double squared = nearest_on_triangle(point, corners(triangle)).squared_distance;
        most = squared < most * most ? std::sqrt(squared) : most;
    });
    return most;
}

void MeshTree::add_to(Dipole &dipole, const TriangleCorners &corners) const
{
    const Vector3 area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double size = area.norm();
    dipole.area += area;
    dipole.size += size;
    dipole.centre += size / 3 * (corners[0] + corners[1] + corners[2]);
}

// Children have larger numbers than their parents.
void MeshTree::list_dipoles()
{
    dipoles_.resize(nodes_.size());
    for (std::size_t index = nodes_.size(); index-- > 0;)
    {
        const Node &node = nodes_[index];
        Dipole dipole;
        for (std::uint32_t i = 0; i < node.count; ++i)
        {
            add_to(dipole, corners(order_[node.first + i]));
        }
        if (node.count == 0)
        {
            for (const Dipole *child : {&dipoles_[index + 1], &dipoles_[node.first]})
            {
                dipole.area += child->area;
                dipole.size += child->size;
                dipole.centre += child->size * child->centre;
            }
        }
        dipole.centre = dipole.size > 0 ? Vector3(dipole.centre / dipole.size) : Vector3((node.low + node.high) / 2);
        dipole.radius = (node.low - dipole.centre).cwiseAbs().cwiseMax((node.high - dipole.centre).cwiseAbs()).norm();
        dipoles_[index] = dipole;
    }
}

double MeshTree::winding_number(const Vector3 &point) const
{
    std::array<std::uint32_t, deepest> waiting;
    int count = 0;
    if (!nodes_.empty())
    {
        waiting[count++] = 0;
    }
    double angle = 0;
    while (count > 0)
    {
        const std::uint32_t index = waiting[--count];
        const Node &node = nodes_[index];
        const Vector3 way = dipoles_[index].centre - point;
        const double distance = way.norm();
        if (distance > far * dipoles_[index].radius)
        {
            angle += dipoles_[index].area.dot(way) / (distance * distance * distance);
        }
        else if (node.count > 0)
        {
            angle += solid_angle_of_leaf(node, point);
        }
        else
        {
            waiting[count++] = node.first;
            waiting[count++] = index + 1;
        }
    }
    return angle / (4 * pi);
}

/// By the formula of van Oosterom and Strackee (1983).
double MeshTree::solid_angle_of_leaf(const Node &node, const Vector3 &point) const
{
    double angle = 0;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    {
        const TriangleCorners at = corners(order_[i]);
        const Vector3 a = at[0] - point, b = at[1] - point, c = at[2] - point;
        const double al = a.norm(), bl = b.norm(), cl = c.norm();
        angle += 2 * std::atan2(a.dot(b.cross(c)), al * bl * cl + a.dot(b) * cl + b.dot(c) * al + c.dot(a) * bl);
    }
    return angle;
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
    {
        return radius;
    }
    SurfaceFeature feature = feature_of(found, triangle, point);
    const auto same = [&](const SurfaceFeature &other) {
        return (other.point - found.point).norm() <= same_place * feature.distance;
    };
    if (std::any_of(features.begin() + static_cast<std::ptrdiff_t>(first), features.end(), same))
    {
        return feature.distance;
    }
    if (!is_minimum(found, triangle, point))
    {
        if (found.part == TrianglePart::corner && fan_size(triangles_[triangle][found.index]) > large_fan)
        {
            feature.triangle = no_minimum; // so that the others of the fan need not look
            features.push_back(feature);
        }
        return feature.distance;
    }
    features.push_back(feature);
    return feature.distance;
}

bool MeshTree::is_minimum(const NearestOnTriangle &nearest, std::uint32_t triangle, const Vector3 &point) const
{
    if (nearest.part == TrianglePart::face)
    {
        return true;
    }
    const Triangle &vertices = triangles_[triangle];
    const std::uint32_t vertex = vertices[nearest.index];
    const std::uint32_t other = nearest.part == TrianglePart::edge ? vertices[(nearest.index + 1) % 3] : vertex;
    for (std::uint32_t i = fan_begin_[vertex]; i < fan_begin_[vertex + 1]; ++i)
    {
        const std::uint32_t neighbour = fans_[i];
        if (neighbour != triangle && has(neighbour, other) &&
            nearest_on_triangle(point, corners(neighbour)).squared_distance < nearer * nearest.squared_distance)
        {
            return false;
        }
    }
    return true;
}

bool MeshTree::has(std::uint32_t triangle, std::uint32_t vertex) const
{
    const Triangle &vertices = triangles_[triangle];
    return vertices[0] == vertex || vertices[1] == vertex || vertices[2] == vertex;
}
} // namespace ode_predictive_space::haptics
