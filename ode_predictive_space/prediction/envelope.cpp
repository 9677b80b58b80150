#include "ode_predictive_space/prediction/envelope.h"

#include <algorithm>

namespace ode_predictive_space
{
Box Envelope::at(double t) const
{
    const Vector3 centre = path.at(t);
    const Vector3 growth = Vector3::Constant(deviation.at(t));
    return Box(centre + low - growth, centre + high + growth);
}

Box Envelope::swept(double duration) const
{
    // Along each axis the path is a parabola: its extremes are its ends and, if it turns between them, its vertex.
    const Vector3 end = path.at(duration);
    Box centres(path.position.cwiseMin(end), path.position.cwiseMax(end));
    for (int axis = 0; axis < 3; ++axis)
    {
        const double turn = -path.velocity[axis] / path.acceleration[axis];
        if (turn > 0 && turn < duration)
        {
            const double extreme = path.position[axis] + 0.5 * path.velocity[axis] * turn;
            centres.min()[axis] = std::min(centres.min()[axis], extreme);
            centres.max()[axis] = std::max(centres.max()[axis], extreme);
        }
    }
    // at() rounds differently: without a margin, its box could exceed this one by some epsilons.
    const Vector3 growth = Vector3::Constant(deviation.at(duration));
    const Vector3 terms = size_of_terms(path, duration) + growth;
    const Vector3 margin_below = rounding_per_size * (terms + low.cwiseAbs());
    const Vector3 margin_above = rounding_per_size * (terms + high.cwiseAbs());
    return Box(centres.min() + low - growth - margin_below, centres.max() + high + growth + margin_above);
}
} // namespace ode_predictive_space
