// Ridges to slide over, and the exact proxy above them.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_RIDGES_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_RIDGES_H

#include "tests/haptics/support/mesh_maker.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace ode_predictive_space::haptics
{
/// Ridges along y, whose profile is straight between multiples of the cell.
struct RidgeShape
{
    double cell = 0.002; ///< m
    int half = 3;        ///< cells from a valley to a ridge
    double top = 0.0015; ///< m; of a ridge above a valley

    /// m; at a multiple of a cell.
    double height(double x) const
    {
        const long place = std::lround(x / cell) % (2 * half);
        return top * static_cast<double>(std::labs((place + 2 * half) % (2 * half) - half)) / half;
    }
};

inline MeshShape ridge_mesh(const RidgeShape &ridges, int across, int along)
{
    MeshShape shape = grid_mesh(ridges.cell, across, along);
    for (Vector3 &vertex : shape.vertices)
        vertex.z() = ridges.height(vertex.x());
    return shape;
}

/// The centre of a probe above the ridges, as Zilles and Salisbury's god object: it descends towards the tool by steps far
/// smaller than the ridges, and stays in the first local minimum.
class ProxyAboveRidges
{
public:
    /// @param radius m; of the probe. @param x m; the first place of the proxy.
    ProxyAboveRidges(const RidgeShape &ridges, double radius, double x) : ridges_(ridges), radius_(radius), x_(x) {}

    Vector3 follow(const Vector3 &tool)
    {
        for (double step = 1e-5; step > 1e-10; step /= 2)
        {
            while (distance(x_ + step, tool) < distance(x_, tool))
                x_ += step;
            while (distance(x_ - step, tool) < distance(x_, tool))
                x_ -= step;
        }
        return {x_, tool.y(), std::max(tool.z(), height(x_))};
    }

private:
    double distance(double x, const Vector3 &tool) const
    {
        return std::hypot(x - tool.x(), std::max(0.0, height(x) - tool.z()));
    }

    /// m; the lowest height of the centre at x: the maximum that the points of the ridges require.
    double height(double x) const
    {
        const int first = static_cast<int>(std::floor((x - radius_) / ridges_.cell)) - 1;
        const int last = static_cast<int>(std::ceil((x + radius_) / ridges_.cell)) + 1;
        double highest = -std::numeric_limits<double>::infinity();
        for (int i = first; i < last; ++i)
        {
            const double from = i * ridges_.cell, to = from + ridges_.cell;
            const double slope = (ridges_.height(to) - ridges_.height(from)) / ridges_.cell;
            // The point of this face, extended to a line, that touches the sphere; or the end nearest to it.
            const double s = std::clamp(x + radius_ * slope / std::hypot(1, slope), from, to);
            if (std::abs(s - x) <= radius_)
            {
                highest = std::max(highest, ridges_.height(from) + slope * (s - from) +
                                                std::sqrt(radius_ * radius_ - (s - x) * (s - x)));
            }
        }
        return highest;
    }

    RidgeShape ridges_;
    double radius_; ///< m
    double x_;      ///< m
};
} // namespace ode_predictive_space::haptics

#endif
