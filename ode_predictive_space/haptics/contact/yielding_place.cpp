#include "ode_predictive_space/haptics/contact/yielding_place.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int passes = 3;                      // of the method of multipliers
constexpr int most_newton_steps = 64;          // of Newton's method; it needs a few
constexpr int most_halvings = 40;              // of a step
constexpr double shortest_newton_step = 1e-12; // of the deepest plane; ends the search
constexpr double least_descent = 0.1;          // of the descent that the slope predicts

/// Compliance of a surface in each pass of find_yielding_place(), as a multiple of its body's displacement by the force
/// in a tick. Three passes act on opposing touches as one pass with 0.75 does. From 0.25 on, the oscillation of light
/// bodies does not grow in any arrangement of touches.
constexpr double yielding = 2.25;

/// The bound of a share is the largest of three: the depth of the deepest plane, `hardest` times the plane's own depth / yield,
/// and `hardest_of_rest` times the depth that remains after the first pass / yield. Without it, the shares of opposing touches
/// would be up to three times as large. A body that bounces off within a few ticks would leave with up to half as much energy
/// again, because its gain depends on the moment between two ticks at which it comes and goes, and grows with the stiffness. A
/// bound by the depth of other planes alone does not act as a spring: it gave bodies of 20 g up to twice their energy.
constexpr double hardest = 0.8;
constexpr double hardest_of_rest = 0.7;

/// A plane with a smaller yield belongs to a heavy body, of more than 28 g at 500 N/m and 1 kHz. Its remaining depth / yield is
/// nearly the share that holds the proxy out of a notch, so its bound is higher.
constexpr double heavy = 0.04;
constexpr double hardest_of_heavy = 1.2;

using Planes = std::vector<ConstraintPlane>;

/// m; the depth of a place behind a plane that keeps its share and yields to the rest.
double remaining_depth(const ConstraintPlane &plane, const Vector3 &place)
{
    return std::max(0.0, plane.depth + plane.yield * plane.share - plane.normal.dot(place));
}

/// m; the bound of the depth behind a plane; infinite for a surface that no push moves.
double most_behind(const ConstraintPlane &plane, const Vector3 &place, double deepest)
{
    if (plane.yield <= rigid_yield)
        return std::numeric_limits<double>::infinity();
    const double of_rest = plane.yield < heavy ? hardest_of_heavy : hardest_of_rest;
    const double own = std::max(hardest * plane.depth, of_rest * remaining_depth(plane, place));
    return std::max(plane.yield * deepest, own);
}

double cost(const Planes &planes, const Vector3 &place)
{
    double sum = place.squaredNorm();
    for (const ConstraintPlane &plane : planes)
    {
        const double behind = remaining_depth(plane, place), counted = std::min(behind, plane.most);
        sum += counted * (2 * behind - counted) / plane.yield;
    }
    return sum / 2;
}

/// Newton's method, which is exact once the carrying planes are known.
class Search
{
public:
    Search(const Planes &planes, double deepest) : planes_(planes), deepest_(deepest)
    {
        for (int step = 0; step < most_newton_steps && go(); ++step)
        {}
    }

    const Vector3 &place() const { return place_; }

private:
    bool go()
    {
        Vector3 gradient = place_;
        Eigen::Matrix3d curvature = Eigen::Matrix3d::Identity();
        for (const ConstraintPlane &plane : planes_)
        {
            const double behind = remaining_depth(plane, place_);
            if (behind == 0)
                continue;
            gradient -= std::min(behind, plane.most) / plane.yield * plane.normal;
            if (behind < plane.most)
                curvature += plane.normal * plane.normal.transpose() / plane.yield;
        }
        const Vector3 step = -curvature.ldlt().solve(gradient);
        if (step.norm() <= shortest_newton_step * deepest_)
            return false;
        const double slope = gradient.dot(step);
        const double before = cost(planes_, place_);
        double part = 1;
        for (int i = 0;
             i < most_halvings && cost(planes_, place_ + part * step) > before + least_descent * part * slope; ++i)
            part /= 2;
        place_ += part * step;
        return part * step.norm() > shortest_newton_step * deepest_;
    }

    const Planes &planes_;
    double deepest_; ///< m
    Vector3 place_ = Vector3::Zero();
};
} // namespace

double yield_of(double stiffness, double mobility, double seconds)
{
    return std::max(rigid_yield, yielding * stiffness * mobility * seconds * seconds);
}

void find_yielding_place(Planes &planes)
{
    const bool finite = are_finite(planes);
    for (ConstraintPlane &plane : planes)
    {
        plane.share = finite ? 0 : plane.depth;
        plane.most = std::numeric_limits<double>::infinity();
    }
    if (!finite)
        return;
    const double deepest = deepest_of(planes);
    for (int pass = 0; pass < passes; ++pass)
    {
        const Vector3 place = Search(planes, deepest).place();
        for (ConstraintPlane &plane : planes)
        {
            plane.most = pass == 0 ? most_behind(plane, place, deepest) : plane.most;
            plane.share = std::min(remaining_depth(plane, place), plane.most) / plane.yield;
        }
    }
}
} // namespace ode_predictive_space::haptics
