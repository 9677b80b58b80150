// The envelope S'(t): a bounding volume that moves along a path and grows by a deviation.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_ENVELOPE_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_ENVELOPE_H

#include <Eigen/Geometry>

#include "ode_predictive_space/prediction/deviation.h"
#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
using Box = Eigen::AlignedBox3d;

/// The box [s(t) + low - R(t), s(t) + high + R(t)], for t from 0 to the horizon. Single sides may be infinite (floors, half
/// spaces). `radius` is that of a sphere around s(t) that holds the object; infinite if no such sphere is known.
struct Envelope
{
    Path path;
    Deviation deviation;
    Vector3 low = Vector3::Zero();
    Vector3 high = Vector3::Zero();
    double radius = 0;

    Envelope advanced(double t) const { return {path.advanced(t), deviation.advanced(t), low, high, radius}; }
};
} // namespace ode_predictive_space

#endif
