// How a program tells callgrind what to count; nothing where valgrind's headers are missing.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_CALLGRIND_REQUESTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_CALLGRIND_REQUESTS_H

#ifdef ODE_PREDICTIVE_SPACE_HAVE_VALGRIND
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_TOGGLE_COLLECT
#endif

#endif
