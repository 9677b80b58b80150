#include "ode_predictive_space/broadphase/shape/nearest_point.h"

#include <algorithm>

#include <Eigen/LU>

namespace ode_predictive_space
{
namespace
{
// Finds the weights of the point of a line, plane or space that is nearest to the origin.
template <int Dimensions, typename Points, typename Weights> bool solve(const Points &points, Weights &weights)
{
    Eigen::Matrix<double, 3, Dimensions> sides;
    for (int i = 0; i < Dimensions; ++i)
        sides.col(i) = points[static_cast<std::size_t>(i + 1)] - points[0];
    Eigen::Matrix<double, Dimensions, Dimensions> inverse = Eigen::Matrix<double, Dimensions, Dimensions>::Zero();
    bool invertible = false;
    const Eigen::Matrix<double, Dimensions, Dimensions> squares = sides.transpose() * sides;
    squares.computeInverseWithCheck(inverse, invertible, 0);
    const Eigen::Matrix<double, Dimensions, 1> found = inverse * (sides.transpose() * -points[0]);
    weights[0] = 1 - found.sum();
    for (int i = 0; i < Dimensions; ++i)
        weights[static_cast<std::size_t>(i + 1)] = found[i];
    return invertible && found.allFinite();
}
} // namespace

bool NearestPoint::add(const Vector3 &corner)
{
    if (count_ == most)
        return false; // the origin is inside
    const double before = point_.squaredNorm();
    points_[static_cast<std::size_t>(count_)] = corner;
    weights_[static_cast<std::size_t>(count_++)] = 0;
    Weights affine{};
    while (count_ > 1 && find_affine(affine))
    {
        const bool within =
            std::all_of(affine.begin(), affine.begin() + count_, [](double weight) { return weight > 0; });
        move_towards(affine);
        if (within)
            break;
        drop_unused();
    }
    point_ = weighted();
    return point_.squaredNorm() < before;
}

// Some weights may be negative: the point is in the line, plane or space through all points, but maybe outside their hull.
bool NearestPoint::find_affine(Weights &weights) const
{
    return count_ == 2   ? solve<1>(points_, weights)
           : count_ == 3 ? solve<2>(points_, weights)
                         : solve<3>(points_, weights);
}

// Moves until a weight would become negative.
void NearestPoint::move_towards(const Weights &weights)
{
    double part = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
        if (weights[i] <= 0 && weights[i] != weights_[i])
            part = std::min(part, weights_[i] / (weights_[i] - weights[i]));
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
    {
        const double moved = weights_[i] + part * (weights[i] - weights_[i]);
        weights_[i] = weights[i] <= 0 && moved <= 1e-12 ? 0 : moved;
    }
}

void NearestPoint::drop_unused()
{
    std::size_t left = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
        if (weights_[i] > 0)
        {
            points_[left] = points_[i];
            weights_[left++] = weights_[i];
        }
    count_ = static_cast<int>(left);
}

Vector3 NearestPoint::weighted() const
{
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
        sum += weights_[i] * points_[i];
    return sum;
}
} // namespace ode_predictive_space
