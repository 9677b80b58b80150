// The shape of a geom, for the shape test.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_GEOM_SHAPE_H
#define ODE_PREDICTIVE_SPACE_SPACE_GEOM_SHAPE_H

#include "ode_predictive_space/broadphase/shape/convex_shape.h"
#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/space/hull_store.h"

namespace ode_predictive_space
{
/// Is the geom made of points, triangles or heights, with contacts that are costly to find?
inline bool has_data(const dxGeom *geom)
{
    return geom->type == dConvexClass || geom->type == dTriMeshClass || geom->type == dHeightfieldClass;
}

/// May ODE use libccd for the contacts of the two, at least in some builds? libccd finds contacts between shapes that are apart
/// by a tenth of their size and more, so that only boxes exclude contacts.
bool found_by_libccd(const dxGeom *one, const dxGeom *other);

/// The shape of a geom with a size, a finite position and a rotation matrix; unknown for others, and for rays, transforms,
/// spaces and user classes. Partners are the classes for which ODE's collider finds no contact beyond a tolerance.
/// @param hull that of a geom with data, whose shape is unknown without it.
ConvexShape shape_of(dxGeom *geom, const std::shared_ptr<const DataHull> &hull);

/// Updates the shape of a geom. While its hull is being made, the shape is unknown and awaits_hull.
/// @param steps see HullStore::hull_of().
/// @return the displacement since the last update, see Scene::follow(), including the growth of a sphere.
double follow_geom(ProxyId id, dxGeom *geom, HullStore &hulls, std::size_t &steps, ConvexShape &shape);
} // namespace ode_predictive_space

#endif
