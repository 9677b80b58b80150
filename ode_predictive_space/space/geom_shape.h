// The shape of a geom, for the shape test.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_GEOM_SHAPE_H
#define ODE_PREDICTIVE_SPACE_SPACE_GEOM_SHAPE_H

#include "ode_predictive_space/broadphase/shape/convex_shape.h"
#include "ode_predictive_space/space/hull_store.h"
#include "ode_predictive_space/space/ode_internals.h"

namespace ode_predictive_space
{
/// Is the geom made of points, triangles or heights, so that its contacts are costly to find?
inline bool has_data(const dxGeom *geom)
{
    return geom->type == dConvexClass || geom->type == dTriMeshClass || geom->type == dHeightfieldClass;
}

/// May ODE let libccd find the contacts of the two? It does for cylinders and convexes with capsules and with each other and,
/// in some builds, for more classes. libccd finds contacts of shapes that are apart by a tenth of their size and more, so that
/// only boxes exclude contacts.
bool found_by_libccd(const dxGeom *one, const dxGeom *other);

/// The shape of a sphere, box, capsule, cylinder, plane, convex, mesh or heightfield that has a size, a finite position and an
/// orthonormal rotation matrix; unknown otherwise. Its partners are the classes for which ODE's collider finds no contact
/// between shapes that are apart by more than a tolerance.
///
/// @param hull required for the shape of a geom with data.
ConvexShape shape_of(dxGeom *geom, const std::shared_ptr<const DataHull> &hull);

/// Updates the shape of a geom. While its hull is being made, the shape is unknown and awaits_hull.
///
/// @param steps see HullStore::hull_of().
/// @return the displacement since the last update, see Scene::follow(), including the growth of a sphere.
double follow_geom(ProxyId id, dxGeom *geom, HullStore &hulls, std::size_t &steps, ConvexShape &shape);
} // namespace ode_predictive_space

#endif
