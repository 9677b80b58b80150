// Any bytes are a program for a predictive and a simple space: both must report the same pairs, and the invariant must hold.

#include <cstdio>
#include <cstdlib>

#include <ode/ode.h>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/history_of_bytes.h"

using namespace ode_predictive_space;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const bool ready = dInitODE2(0) != 0 && dAllocateODEDataForThread(dAllocateMaskAll) != 0;
    const FuzzedRun run = run_of_bytes(data, size);
    const std::optional<Failure> failure = ready ? compare(run.history, run.terms) : std::nullopt;
    // A history that ODE's own space does not allow is no program.
    if (failure && failure->kind != FailureKind::abort_in_reference)
    {
        std::fprintf(stderr, "measure %d, operation %zu: %s\n%s", static_cast<int>(run.terms.measure),
                     failure->operation, failure->text.c_str(), to_text(run.history).c_str());
        std::abort();
    }
    return 0;
}
