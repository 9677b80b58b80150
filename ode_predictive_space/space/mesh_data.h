// What a mesh is made of: where its vertices and triangles are. ODE has no function that tells.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_MESH_DATA_H
#define ODE_PREDICTIVE_SPACE_SPACE_MESH_DATA_H

#include <ode/collision.h>

namespace ode_predictive_space
{
/// The first members of ODE's data of a mesh, in ODE 0.16. The arrays are the program's own.
struct MeshData
{
    const void *vertices; ///< of 3 floats or doubles each
    int vertex_stride;    ///< bytes from one to the next
    unsigned vertex_count;
    const void *triangles; ///< of 3 indices of vertices each, of 32 bits
    unsigned triangle_count;
    int triangle_stride;
    bool single; ///< vertices of floats
};

/// The data of a mesh; null when it has none or when the ODE in this process keeps it in another way, as ODE 0.15 does.
const MeshData *mesh_data_of(dGeomID mesh);
} // namespace ode_predictive_space

#endif
