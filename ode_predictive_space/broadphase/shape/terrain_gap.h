// How far a convex shape is above a heightfield, or beside higher ground, from below.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_TERRAIN_GAP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_TERRAIN_GAP_H

#include "ode_predictive_space/broadphase/shape/gap.h"

namespace ode_predictive_space
{
/// No ground of the terrain is nearer to the other shape than this, rounded down, and no more than a few sizes of the other one. The
/// terrain is solid however deep. No axis is known. No gap when its heights are not finite, or when it repeats within a few sizes. Its grid is
/// ready.
///
/// @param least no smaller gap is of use: the search ends with the first cell that is no farther away.
Gap terrain_gap(const ConvexShape &terrain, const ConvexShape &other, double least);
} // namespace ode_predictive_space

#endif
