// Counts calls of operator new in all threads and shared libraries, for tests that a servo loop makes none.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_ALLOCATION_COUNT_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_ALLOCATION_COUNT_H

#include <cstdint>

namespace ode_predictive_space::haptics
{
std::uint64_t allocation_count();
} // namespace ode_predictive_space::haptics

#endif
