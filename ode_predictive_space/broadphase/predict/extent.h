// The bounds of an envelope around its path, from what is seen of the object.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_EXTENT_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_EXTENT_H

#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "ode_predictive_space/broadphase/objects/scene.h"

namespace ode_predictive_space
{
/// The point that the path is about: the object's centre or, where none is known, the middle of what is finite of its box.
Vector3 centre_of(const Observation &seen);

/// Writes the envelope's bounds around `centre`, how it is checked, and whether tight bounds last.
///
/// @param step ticks' worth of motion that a unit of velocity is.
void set_extent(ProxyRecord &record, const Observation &seen, const Vector3 &centre, double step);

/// Half the mean extent of the finite sides: the unit of slack, reach and widening.
double size_of(const ProxyRecord::Prediction &prediction);

/// Can a tree hold the bounds?
bool is_bounded(const ProxyRecord::Prediction &prediction);
} // namespace ode_predictive_space

#endif
