// The shape of a geom, where contacts follow from it.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_GEOM_SHAPE_H
#define ODE_PREDICTIVE_SPACE_SPACE_GEOM_SHAPE_H

#include "ode_predictive_space/broadphase/shape/convex_shape.h"
#include "ode_predictive_space/space/hull_store.h"
#include "ode_predictive_space/space/ode_internals.h"

namespace ode_predictive_space
{
/// Is the geom made of points, triangles or heights, from which its contacts are dear to find?
inline bool has_data(const dxGeom *geom)
{
    return geom->type == dConvexClass || geom->type == dTriMeshClass || geom->type == dHeightfieldClass;
}

/// Does ODE have libccd find the contacts of the two? Of cylinders and convexes with capsules, with each other and, in some builds, with more. It
/// finds some between shapes that are apart by a tenth of their size and more, so that boxes alone tell whether there are any.
bool found_by_libccd(const dxGeom *one, const dxGeom *other);

/// The shape of a sphere, box, capsule, cylinder, plane, convex, mesh or heightfield that has a size, a finite place and an orthonormal rotation
/// matrix; unknown otherwise. Two shapes are judged together where ODE's own collider finds no contact between shapes that are
/// apart by more than a tolerance.
///
/// @param hull of a geom with data. Without it the shape of that is unknown.
ConvexShape shape_of(dxGeom *geom, const std::shared_ptr<const DataHull> &hull);

/// Brings the shape of a geom up to date. While its hull is being made, it is unknown, and awaits_hull.
///
/// @param steps see HullStore::hull_of().
/// @return how far it has moved since; see Scene::follow(). Of a sphere, with what it has grown.
double follow_geom(ProxyId id, dxGeom *geom, HullStore &hulls, std::size_t &steps, ConvexShape &shape);
} // namespace ode_predictive_space

#endif
