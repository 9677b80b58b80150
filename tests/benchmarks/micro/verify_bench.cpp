// Verification: is the centre of each moved object where its path says?

#include "ode_predictive_space/broadphase/verify/checks.h"
#include "tests/benchmarks/micro/inputs.h"

#include <array>
#include <benchmark/benchmark.h>

namespace ode_predictive_space::micro
{
namespace
{
using Centre = std::array<double, 4>; // as in an ODE body

struct Moved
{
    std::vector<PackedPath> paths;
    std::vector<Centre> centres;
};

Moved moved_objects(std::size_t count)
{
    Random random(1);
    Moved result;
    for (std::size_t i = 0; i < count; ++i)
    {
        const Envelope envelope = random_envelope(random, half_room(count));
        PackedPath path{};
        path.set_path(envelope.path);
        path.set_deviation({envelope.deviation.a, envelope.deviation.b, 0});
        const Vector3 centre = path.path().at(1);
        result.paths.push_back(path);
        result.centres.push_back({centre.x(), centre.y(), centre.z(), 0});
    }
    return result;
}

/// All of them, one by one; items are objects.
void verify_centres(benchmark::State &state)
{
    const Moved moved = moved_objects(static_cast<std::size_t>(state.range(0)));
    std::size_t inside = 0;
    while (state.KeepRunning())
    {
        for (std::size_t i = 0; i < moved.paths.size(); ++i)
        {
            inside += centre_inside(moved.paths[i], moved.centres[i].data(), 1) ? 1 : 0;
        }
    }
    if (inside != static_cast<std::size_t>(state.iterations()) * moved.paths.size())
    {
        state.SkipWithError("an object is outside its envelope");
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(verify_centres)->ArgName("n")->Arg(100)->Arg(1000)->Arg(10000)->Arg(100000);
} // namespace
} // namespace ode_predictive_space::micro
