#include "ode_predictive_space/prediction/envelope.h"

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
    // Along an axis the path is a parabola: its extremes are its ends and, if it turns in between, its vertex.
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
    const Vector3 growth = Vector3::Constant(deviation.at(duration));
    return Box(centres.min() + low - growth, centres.max() + high + growth);
}
} // namespace ode_predictive_space
