#ifndef ODE_PREDICTIVE_SPACE_RECORDING_GEOM_OF_STATE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_GEOM_OF_STATE_H

#include <ode/collision.h>

#include "ode_predictive_space/recording/state.h"

namespace ode_predictive_space::recording
{
/// Makes a primitive or a stand-in. The class data of a stand-in is the address of its box, six numbers; 0 until it is set.
dGeomID make_simple_shape(const GeomState &state);

void set_size(dGeomID geom, const GeomState &state);
void set_flags(dGeomID geom, const GeomState &state);

void set_levels(dSpaceID space, const GeomState &state);

/// Copies the rotation of a pose into a matrix of ODE's, 3 x 4 numbers.
void copy_rotation(const Pose &pose, dReal *rotation);
} // namespace ode_predictive_space::recording

#endif
