// What a fuzz target defines. libFuzzer calls it with bytes of its own, the replay with those of the corpus.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_FUZZ_FUZZ_TARGET_H
#define ODE_PREDICTIVE_SPACE_TESTS_FUZZ_FUZZ_TARGET_H

#include <cstddef>
#include <cstdint>

/// Runs what is tested with any bytes, and ends the process when that fails. @return 0, as libFuzzer asks for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

#endif
