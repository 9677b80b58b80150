// How often the program asked for memory: for tests that nothing in a servo loop does.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_ALLOCATION_COUNT_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_ALLOCATION_COUNT_H

#include <cstdint>

namespace ode_predictive_space::haptics
{
/// Calls of operator new so far, by all threads, those within shared libraries included.
std::uint64_t allocation_count();
} // namespace ode_predictive_space::haptics

#endif
