// Vectors of four floats and of eight 16-bit integers: the only vector arithmetic of the broad phase.
//
// There are two implementations with the same results, bit for bit: SSE2, and a scalar twin for all other processors. The
// twin is chosen by ODE_PREDICTIVE_SPACE_SCALAR, too, so that it is compiled and tested everywhere.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_SIMD_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_SIMD_H

#if defined(__SSE2__) && !defined(ODE_PREDICTIVE_SPACE_SCALAR)
#include "ode_predictive_space/broadphase/base/simd_sse2.h"
#else
#include "ode_predictive_space/broadphase/base/simd_scalar.h"
#endif

namespace ode_predictive_space
{
/// Bits of the first three lanes of a Mask4, and of all four.
constexpr unsigned three_lanes = 7, four_lanes = 15;
} // namespace ode_predictive_space

#endif
