// The first members of a hash space, for spaces that replace one.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_HASH_LEVELS_H
#define ODE_PREDICTIVE_SPACE_SPACE_HASH_LEVELS_H

#include "ode_predictive_space/space/ode_internals.h"

/// Only dHashSpaceGetLevels() and dHashSpaceSetLevels() read the members, which they expect directly after those of dxSpace.
/// The values are those of a new hash space.
struct dxSpaceWithHashLevels : public dxSpace
{
    int global_minlevel = -3;
    int global_maxlevel = 10;

protected:
    explicit dxSpaceWithHashLevels(dxSpace *parent) : dxSpace(parent) {}
};

#endif
