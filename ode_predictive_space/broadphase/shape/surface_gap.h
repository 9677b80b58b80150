// A lower bound of the distance of a convex shape from a heightfield or a mesh's triangles, also inside a mesh's hull.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_SURFACE_GAP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_SURFACE_GAP_H

#include "ode_predictive_space/broadphase/shape/gap.h"

namespace ode_predictive_space
{
/// The shape of the pair that acts as the surface: terrain, or the mesh with more triangles. Null if neither has a surface, if
/// the pair is not judged_by_shape(), and beside a half space, which touches a mesh only where it touches its hull.
const ConvexShape *surface_of(const ConvexShape &first, const ConvexShape &second);

/// A lower bound of the distance between surface_of() the pair and the other shape, at most a few of its sizes. No axis.
/// @param least the smallest useful gap: the search ends with the first triangle or cell that is no farther away.
Gap surface_gap(const ConvexShape &first, const ConvexShape &second, double least);
} // namespace ode_predictive_space

#endif
