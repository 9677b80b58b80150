// Any bytes are a history of geoms under the sphere or the shape test: each pair with contacts has a callback.

#include <cstdio>
#include <cstdlib>

#include <ode/ode.h>

#include "tests/fuzz/contact_history.h"
#include "tests/fuzz/fuzz_target.h"

using namespace ode_predictive_space;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const bool ready = dInitODE2(0) != 0 && dAllocateODEDataForThread(dAllocateMaskAll) != 0;
    ContactTally tally;
    if (!ready || !run_contact_history(data, size, tally).empty())
    {
        std::fprintf(stderr, "%s\n", ready ? report_of_contact_history(data, size).c_str() : "ODE does not start");
        std::abort();
    }
    return 0;
}
