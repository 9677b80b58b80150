#include "ode_predictive_space/haptics/contact/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double tolerances[] = {1e-9, 1e-6};   // of the deepest plane
constexpr double farthest = 100;                // times the deepest plane; a groove of 1.15 degrees
constexpr double smallest_squared_sine = 1e-10; // of two normals' angle; below, one plane stands for both
constexpr double smallest_volume = 1e-9;        // of three normals
constexpr int most_rounds = 64;                 // rounding could make the search cycle

struct Carriers
{
    std::array<std::size_t, 3> planes{};
    std::array<double, 3> shares{};
    int count = 0;
    Vector3 point = Vector3::Zero(); // from the tool
};

using Planes = std::vector<ConstraintPlane>;

/// The point on all of the carriers' planes nearest to the tool: the shares solve normal_i . sum(share_j normal_j) =
/// depth_i. @return false when the normals are too close to dependent.
bool solve(const Planes &planes, Carriers &carriers)
{
    const auto normal = [&](int i) -> const Vector3 & { return planes[carriers.planes[i]].normal; };
    const auto depth = [&](int i) { return planes[carriers.planes[i]].depth; };
    auto &shares = carriers.shares;

    if (carriers.count == 1)
        shares[0] = depth(0);
    else if (carriers.count == 2)
    {
        const double cosine = normal(0).dot(normal(1));
        const double squared_sine = normal(0).cross(normal(1)).squaredNorm();
        if (squared_sine < smallest_squared_sine)
            return false;
        shares[0] = (depth(0) - cosine * depth(1)) / squared_sine;
        shares[1] = (depth(1) - cosine * depth(0)) / squared_sine;
    }
    else
    {
        // The columns of the inverse of the matrix whose rows are the normals, times its determinant.
        const Vector3 dual[3] = {normal(1).cross(normal(2)), normal(2).cross(normal(0)), normal(0).cross(normal(1))};
        const double volume = normal(0).dot(dual[0]);
        if (std::abs(volume) < smallest_volume)
            return false;
        const Vector3 corner = (depth(0) * dual[0] + depth(1) * dual[1] + depth(2) * dual[2]) / volume;
        for (int i = 0; i < 3; ++i)
            shares[i] = corner.dot(dual[i]) / volume;
    }

    carriers.point = Vector3::Zero();
    for (int i = 0; i < carriers.count; ++i)
        carriers.point += shares[i] * normal(i);
    return true;
}

double violation(const ConstraintPlane &plane, const Vector3 &point)
{
    return plane.depth - plane.normal.dot(point);
}

/// Whether `added` and the carriers whose bits are set in `kept` also satisfy the remaining carriers.
bool try_carriers(const Planes &planes, const Carriers &carriers, unsigned kept, std::size_t added, double allowed,
                  Carriers &result)
{
    result.count = 0;
    for (int i = 0; i < carriers.count; ++i)
        if ((kept >> i) & 1u)
            result.planes[result.count++] = carriers.planes[i];
    if (result.count == 3)
        return false;
    result.planes[result.count++] = added;

    if (!solve(planes, result))
        return false;
    for (int i = 0; i < result.count; ++i)
        if (result.shares[i] < 0)
            return false; // it would pull
    for (int i = 0; i < carriers.count; ++i)
        if (violation(planes[carriers.planes[i]], result.point) > allowed)
            return false;
    return true;
}

/// Replaces the carriers by the solution among them and one violated plane. It is unique, and with at most four planes
/// all combinations are tried.
bool exchange(const Planes &planes, Carriers &carriers, std::size_t added, double allowed)
{
    Carriers result;
    for (unsigned kept = 0; kept < (1u << carriers.count); ++kept)
        if (try_carriers(planes, carriers, kept, added, allowed, result))
        {
            carriers = result;
            return true;
        }
    return false;
}

/// Each round adds the plane violated most, which lifts the point: an LP-type problem of dimension 3 (Sharir and Welzl 1992).
std::optional<Carriers> find_carriers(const Planes &planes, double deepest, double tolerance)
{
    const double allowed = tolerance * deepest;
    Carriers carriers;
    for (int round = 0; round < most_rounds; ++round)
    {
        std::size_t worst = 0;
        for (std::size_t i = 1; i < planes.size(); ++i)
            if (violation(planes[i], carriers.point) > violation(planes[worst], carriers.point))
                worst = i;
        if (!(violation(planes[worst], carriers.point) > allowed))
            return carriers;
        if (!exchange(planes, carriers, worst, allowed) || carriers.point.norm() > farthest * deepest)
            break;
    }
    return std::nullopt;
}
} // namespace

bool are_finite(const std::vector<ConstraintPlane> &planes)
{
    return std::all_of(planes.begin(), planes.end(), [](const ConstraintPlane &plane) {
        return std::isfinite(plane.depth) && std::isfinite(plane.yield) && plane.normal.allFinite();
    });
}

double deepest_of(const std::vector<ConstraintPlane> &planes)
{
    double deepest = 0;
    for (const ConstraintPlane &plane : planes)
        deepest = std::max(deepest, plane.depth);
    return deepest;
}

Vector3 lift_of(const std::vector<ConstraintPlane> &planes)
{
    Vector3 lift = Vector3::Zero();
    for (const ConstraintPlane &plane : planes)
        lift += plane.share * plane.normal;
    return lift;
}

bool find_closest_point(std::vector<ConstraintPlane> &planes)
{
    if (planes.empty())
        return true;

    std::optional<Carriers> carriers;
    const double deepest = deepest_of(planes);
    if (are_finite(planes))
        for (const double tolerance : tolerances)
            carriers = carriers ? carriers : find_carriers(planes, deepest, tolerance);
    for (ConstraintPlane &plane : planes)
        plane.share = carriers ? 0 : plane.depth;
    for (int i = 0; carriers && i < carriers->count; ++i)
        planes[carriers->planes[i]].share = carriers->shares[i];
    return carriers.has_value();
}
} // namespace ode_predictive_space::haptics
