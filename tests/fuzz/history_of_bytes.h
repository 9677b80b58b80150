#ifndef ODE_PREDICTIVE_SPACE_TESTS_FUZZ_HISTORY_OF_BYTES_H
#define ODE_PREDICTIVE_SPACE_TESTS_FUZZ_HISTORY_OF_BYTES_H

#include <cstddef>
#include <cstdint>

#include "tests/differential/comparison.h"

namespace ode_predictive_space
{
struct FuzzedRun
{
    History history;
    Terms terms;
};

/// One byte of settings, then eight bytes for each operation: action, subject, object, number and four values. The last actions
/// stand for many operations each. Operations after the 200th are ignored. All bytes are valid, and the operations are legal.
FuzzedRun run_of_bytes(const std::uint8_t *data, std::size_t size);
} // namespace ode_predictive_space

#endif
