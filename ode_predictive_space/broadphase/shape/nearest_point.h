// The point of a growing simplex that is nearest to the origin.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_NEAREST_POINT_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_NEAREST_POINT_H

#include <array>

#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
/// Converges to a convex shape's nearest point to the origin, if each added corner is the farthest one against the direction of
/// point(). Unused corners are dropped, so that at most four remain. (P. Wolfe: Finding the nearest point in a polytope, 1976)
class NearestPoint
{
public:
    explicit NearestPoint(const Vector3 &first) : points_{first}, weights_{1}, point_(first) {}

    const Vector3 &point() const { return point_; }

    /// @return false if the point comes no nearer: up to rounding, it is the nearest one.
    bool add(const Vector3 &corner);

private:
    static constexpr int most = 4;
    using Weights = std::array<double, most>;

    bool find_affine(Weights &weights) const;
    void move_towards(const Weights &weights);
    void drop_unused();
    Vector3 weighted() const;

    std::array<Vector3, most> points_;
    Weights weights_{};
    int count_ = 1;
    Vector3 point_;
};
} // namespace ode_predictive_space

#endif
