// A lower bound of the distance of a convex shape above a heightfield, or beside higher ground.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_TERRAIN_GAP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_TERRAIN_GAP_H

#include "ode_predictive_space/broadphase/shape/gap.h"

namespace ode_predictive_space
{
/// A lower bound of the distance between the terrain, solid to any depth, and the other shape, at most a few of its sizes. No
/// axis is known. No gap if heights are not finite, or if the terrain repeats within a few sizes. @pre its grid is ready.
/// @param least the smallest useful gap: the search ends with the first cell that is no farther away.
Gap terrain_gap(const ConvexShape &terrain, const ConvexShape &other, double least);
} // namespace ode_predictive_space

#endif
