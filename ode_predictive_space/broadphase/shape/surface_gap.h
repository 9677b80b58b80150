// How far a convex shape is from the triangles of a mesh or from a heightfield, from below: also within a mesh's hull, as in a room.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_SURFACE_GAP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_SURFACE_GAP_H

#include "ode_predictive_space/broadphase/shape/gap.h"

namespace ode_predictive_space
{
/// Which of two shapes is the surface that the other one is held against: terrain, or of two meshes the one with more triangles.
/// Null when none is, when the pair is not judged_by_shape(), and beside a half space, which touches a mesh where it touches its hull.
const ConvexShape *surface_of(const ConvexShape &first, const ConvexShape &second);

/// Nothing of the surface_of() two shapes is nearer to the other one than this, rounded down: as far as a few axes for each triangle
/// tell, and no more than a few sizes of the other one. No axis is known. No gap without a surface.
///
/// @param least no smaller gap is of use: the search ends with the first triangle that is no farther away.
Gap surface_gap(const ConvexShape &first, const ConvexShape &second, double least);
} // namespace ode_predictive_space

#endif
