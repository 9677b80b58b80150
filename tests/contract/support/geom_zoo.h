// One of every class of geom, with bounds of every awkward kind: off-centre, infinite, without a position.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_GEOM_ZOO_H
#define ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_GEOM_ZOO_H

#include <ode/ode.h>

namespace ode_predictive_space
{
enum class GeomKind
{
    sphere,
    box,
    capsule,
    cylinder,
    ray,
    convex,             ///< a cube whose centre is away from its position
    trimesh,            ///< a tetrahedron, away from its position
    heightfield,        ///< finite and placeable; its position is a matter of its centre
    transform,          ///< a dGeomTransform around a sphere that is away from its position
    user,               ///< a user class with bounds away from its position and an AABBTest
    plane,              ///< with its normal along an axis: a half space
    oblique_plane,      ///< infinite
    endless_heightfield ///< wrapped and not placeable: infinite in x and z
};

constexpr int geom_kind_count = 13;

const char *geom_kind_name(GeomKind kind);

/// Kinds that have a position, and so can be moved and carried by a body. All others are unbounded on some side.
bool is_placeable(GeomKind kind);

/// Makes a geom of about the given size (convexes, meshes and heightfields come in the sizes 0.3, 1 and 3 only).
dGeomID create_geom(GeomKind kind, dReal size, dSpaceID space);

/// Gives a geom that create_geom() made another size and tells the space by setting its position anew: ODE gives no notice
/// of its own when a convex, a mesh, a heightfield or a transform is changed.
void resize_geom(dGeomID geom, GeomKind kind, dReal size);
/// The triangles of a mesh of that size.
dTriMeshDataID mesh_data(dReal size);
} // namespace ode_predictive_space

#endif
