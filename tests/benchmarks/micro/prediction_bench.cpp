// Prediction: fitting a path, the times of proximity of two spheres and of two boxes.

#include "ode_predictive_space/prediction/least_squares.h"
#include "ode_predictive_space/prediction/proximity.h"
#include "tests/benchmarks/micro/inputs.h"

#include <benchmark/benchmark.h>

namespace ode_predictive_space::micro
{
namespace
{
constexpr std::size_t pairs = 512; // they stay in the first-level cache, and no branch predictor learns them
constexpr double horizon = 64;     // ticks

struct Pair
{
    Envelope first;
    Envelope second;
};

/// Pairs half of which come near each other within the horizon, or thereabouts.
std::vector<Pair> random_pairs()
{
    Random random(1);
    std::vector<Pair> result;
    for (std::size_t i = 0; i < pairs; ++i)
    {
        result.push_back({random_envelope(random, 0.15), random_envelope(random, 0.15)});
    }
    return result;
}

void least_squares(benchmark::State &state)
{
    Random random(1);
    std::vector<Sample> samples;
    const int count = static_cast<int>(state.range(0));
    samples.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
    {
        samples.push_back({i + 1.0 - count, random.vector(1)});
    }
    while (state.KeepRunning())
    {
        benchmark::DoNotOptimize(samples.data());
        benchmark::DoNotOptimize(fit_path(samples.data(), count));
    }
}
BENCHMARK(least_squares)->ArgName("samples")->Arg(3)->Arg(8)->Arg(16);

void sphere_proximity(benchmark::State &state)
{
    const std::vector<Pair> inputs = random_pairs();
    std::size_t next = 0;
    while (state.KeepRunning())
    {
        const Pair &pair = inputs[next++ % pairs];
        benchmark::DoNotOptimize(sphere_time_of_proximity(pair.first, pair.second, horizon));
    }
}
BENCHMARK(sphere_proximity);

void box_proximity(benchmark::State &state)
{
    const std::vector<Pair> inputs = random_pairs();
    std::size_t next = 0;
    while (state.KeepRunning())
    {
        const Pair &pair = inputs[next++ % pairs];
        benchmark::DoNotOptimize(box_time_of_proximity(pair.first, pair.second, horizon));
    }
}
BENCHMARK(box_proximity);

void swept_box(benchmark::State &state)
{
    const std::vector<Pair> inputs = random_pairs();
    std::size_t next = 0;
    while (state.KeepRunning())
    {
        benchmark::DoNotOptimize(FloatBox::around(inputs[next++ % pairs].first.swept(horizon)));
    }
}
BENCHMARK(swept_box);
} // namespace
} // namespace ode_predictive_space::micro
