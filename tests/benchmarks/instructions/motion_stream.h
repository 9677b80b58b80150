// Motion on its way from one process to another on the same machine.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_MOTION_STREAM_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_MOTION_STREAM_H

#include "tests/benchmarks/replay.h"

#include <cstdio>

namespace ode_predictive_space::benchmarks
{
/// Write the moves of one tick.
///
/// @throws std::runtime_error when they cannot be written.
void write_moves(std::FILE *out, const std::vector<Move> &moves);

/// Read what one write_moves() has written.
///
/// @throws std::runtime_error when the input ends before.
std::vector<Move> read_moves(std::FILE *in);
} // namespace ode_predictive_space::benchmarks

#endif
