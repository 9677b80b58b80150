// The place of a surface that is nearest to a point, at least around there.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SURFACE_FEATURE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SURFACE_FEATURE_H

#include "ode_predictive_space/haptics/touch.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// A local minimum of the distance between a point and a surface. Lengths in m.
struct SurfaceFeature
{
    Vector3 point = Vector3::Zero();   ///< on the surface
    Vector3 normal = Vector3::UnitZ(); ///< of length 1; from the surface towards the point
    double distance = 0;               ///< below 0 inside of a solid
    int triangle = -1;                 ///< of a mesh: which one
};

using SurfaceFeatures = std::vector<SurfaceFeature>;
} // namespace ode_predictive_space::haptics

#endif
