// Access to the vertices and triangles of a mesh, for which ODE has no function.

#ifndef ODE_PREDICTIVE_SPACE_ODE_MESH_DATA_H
#define ODE_PREDICTIVE_SPACE_ODE_MESH_DATA_H

#include <ode/collision.h>

#include "ode_predictive_space/surface/triangle_arrays.h"

namespace ode_predictive_space
{
/// The data of a mesh; null without data, or if the ODE in this process has another layout, as ODE 0.15 has.
const TriangleArrays *mesh_data_of(dGeomID mesh);
} // namespace ode_predictive_space

#endif
