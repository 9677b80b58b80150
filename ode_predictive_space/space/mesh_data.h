// What a mesh is made of: where its vertices and triangles are. ODE has no function that tells.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_MESH_DATA_H
#define ODE_PREDICTIVE_SPACE_SPACE_MESH_DATA_H

#include <ode/collision.h>

#include "ode_predictive_space/surface/triangle_arrays.h"

namespace ode_predictive_space
{
/// The data of a mesh; null when it has none or when the ODE in this process keeps it in another way, as ODE 0.15 does.
const TriangleArrays *mesh_data_of(dGeomID mesh);
} // namespace ode_predictive_space

#endif
