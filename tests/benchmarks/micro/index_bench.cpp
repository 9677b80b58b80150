// The envelope index: the tree, built, queried and changed; and sort and sweep.

#include "ode_predictive_space/broadphase/index/envelope_tree.h"
#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"
#include "tests/benchmarks/micro/inputs.h"

#include <benchmark/benchmark.h>

namespace ode_predictive_space::micro
{
namespace
{
constexpr double horizon = 64; // ticks

void sizes(benchmark::internal::Benchmark *bench)
{
    bench->ArgName("n")->Arg(100)->Arg(1000)->Arg(10000)->Arg(100000);
}

std::size_t size_of(const benchmark::State &state)
{
    return static_cast<std::size_t>(state.range(0));
}

void count_objects(benchmark::State &state)
{
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// Of the whole tree; items are leaves.
void tree_build(benchmark::State &state)
{
    const std::vector<SweptProxy> boxes = swept_boxes(size_of(state), horizon);
    EnvelopeTree tree;
    while (state.KeepRunning())
    {
        std::vector<SweptProxy> leaves = boxes;
        tree.build(leaves);
    }
    count_objects(state);
}
BENCHMARK(tree_build)->Apply(sizes);

/// One by one into an empty tree; items are leaves.
void tree_insert(benchmark::State &state)
{
    const std::vector<SweptProxy> boxes = swept_boxes(size_of(state), horizon);
    while (state.KeepRunning())
    {
        EnvelopeTree tree;
        for (const SweptProxy &swept : boxes)
        {
            tree.insert(swept.proxy, swept.box);
        }
        benchmark::DoNotOptimize(tree.depth());
    }
    count_objects(state);
}
BENCHMARK(tree_insert)->Apply(sizes);

/// A leaf gets a box near its old one, as at the end of a horizon.
void tree_move(benchmark::State &state)
{
    std::vector<SweptProxy> boxes = swept_boxes(size_of(state), horizon);
    EnvelopeTree tree;
    tree.build(boxes);
    Random random(2);
    while (state.KeepRunning())
    {
        SweptProxy &swept = boxes[random.index(boxes.size())];
        const float way = static_cast<float>(random.uniform(-0.02, 0.02));
        for (int axis = 0; axis < 3; ++axis)
        {
            swept.box.low[axis] += way;
            swept.box.high[axis] += way;
        }
        tree.move(swept.proxy, swept.box);
    }
}
BENCHMARK(tree_move)->Apply(sizes);

/// What a newly predicted envelope can meet.
void tree_query(benchmark::State &state)
{
    std::vector<SweptProxy> boxes = swept_boxes(size_of(state), horizon);
    const std::vector<SweptProxy> probes = boxes;
    EnvelopeTree tree;
    tree.build(boxes);
    Random random(2);
    std::size_t found = 0;
    while (state.KeepRunning())
    {
        tree.walk(BoxProbe(probes[random.index(probes.size())].box), [&](ProxyId) { ++found; });
    }
    state.counters["found"] = benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
}
BENCHMARK(tree_query)->Apply(sizes);

/// All pairs of boxes as they are now, from scratch; items are boxes.
void sort_and_sweep(benchmark::State &state)
{
    const std::vector<SweptProxy> boxes = swept_boxes(size_of(state), 0);
    SortAndSweep sort_and_sweep;
    std::vector<CandidatePair> found;
    while (state.KeepRunning())
    {
        found.clear();
        sort_and_sweep.find_pairs(boxes, found);
    }
    count_objects(state);
    state.counters["found"] = static_cast<double>(found.size());
}
BENCHMARK(sort_and_sweep)->Apply(sizes);
} // namespace
} // namespace ode_predictive_space::micro
