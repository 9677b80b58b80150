// The beginning of a hash space, for spaces that stand in for one.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_HASH_LEVELS_H
#define ODE_PREDICTIVE_SPACE_SPACE_HASH_LEVELS_H

#include "ode_predictive_space/space/ode_internals.h"

/// dHashSpaceGetLevels() and dHashSpaceSetLevels() expect these two members right behind those of dxSpace, with the values that a
/// new hash space has. Nothing else reads them.
struct dxSpaceWithHashLevels : public dxSpace
{
    int global_minlevel = -3;
    int global_maxlevel = 10;

protected:
    explicit dxSpaceWithHashLevels(dxSpace *parent) : dxSpace(parent) {}
};

#endif
