#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_HEAP_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_HEAP_H

#include <malloc.h>

namespace ode_predictive_space::benchmarks
{
inline double heap_in_use()
{
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}
} // namespace ode_predictive_space::benchmarks

#endif
