// Bytes per geom, and their growth while geoms come and go.

#include "tests/benchmarks/heap.h"
#include "tests/benchmarks/results.h"

#include <algorithm>
#include <ode_predictive_space/predictive_space.h>

namespace
{
using namespace ode_predictive_space;
using namespace ode_predictive_space::benchmarks;
using namespace ode_predictive_space::worlds;

struct Memory
{
    double counted = 0;   ///< bytes as a predictive space counts them; 0 for others
    double allocated = 0; ///< bytes that the program has allocated since before the world
    double near = 0;      ///< pairs in the near set of a predictive space
};

dPredictiveSpaceStats stats_of(dSpaceID space)
{
    dPredictiveSpaceStats stats{};
    if (dSpaceIsPredictive(space) != 0)
        dPredictiveSpaceGetStats(space, &stats);
    return stats;
}

class MemoryRun
{
public:
    /// @param collides false: the world is advanced without collision.
    MemoryRun(const WorldFactory &factory, SpaceKind kind, bool collides)
        : before_(heap_in_use()), space_(make_space(kind, factory)), world_(factory.make(space_.get())),
          collides_(collides)
    {}

    void make(int ticks)
    {
        PairList pairs;
        for (int tick = 0; tick < ticks; ++tick)
        {
            world_->advance();
            if (!collides_)
                continue;
            pairs.clear();
            world_->collide(space_.get(), &pairs, PairList::near);
            world_->respond(pairs.sorted());
        }
    }

    Memory memory() const
    {
        const dPredictiveSpaceStats stats = stats_of(space_.get());
        return {static_cast<double>(stats.bytes), heap_in_use() - before_, static_cast<double>(stats.near_pairs)};
    }

private:
    double before_;
    OwnedSpace space_; // outlives the world, whose geoms it holds
    std::unique_ptr<World> world_;
    bool collides_;
};

Memory memory_of(const WorldFactory &factory, SpaceKind kind, int ticks, bool collides = true)
{
    MemoryRun run(factory, kind, collides);
    run.make(ticks);
    return run.memory();
}

nlohmann::json measure(const WorldSpec &spec, SpaceKind kind, int ticks)
{
    const WorldFactory factory(spec);
    const double alone = memory_of(factory, SpaceKind::simple, ticks, false).allocated;
    const Memory memory = memory_of(factory, kind, ticks);
    return {{"scene", spec.name},
            {"n", spec.objects},
            {"space", space_name(kind)},
            {"ticks", ticks},
            {"counted", memory.counted / spec.objects},
            {"allocated", (memory.allocated - alone) / spec.objects},
            {"near pairs", memory.near}};
}

/// The largest sample of a run's second half, divided by that of the first half after a tenth, in which a space fills up.
nlohmann::json measure_growth(const WorldSpec &spec, int ticks)
{
    constexpr int samples = 100;
    const WorldFactory factory(spec);
    MemoryRun run(factory, SpaceKind::predictive, true);
    double first = 0, second = 0;
    for (int sample = 0; sample < samples; ++sample)
    {
        run.make(std::max(1, ticks / samples));
        double &largest = sample < samples / 2 ? first : second;
        if (sample >= samples / 10)
            largest = std::max(largest, run.memory().counted);
    }
    return {{"scene", spec.name}, {"n", spec.objects}, {"ticks", ticks}, {"second half / first half", second / first}};
}

nlohmann::json measure_all(int objects, int ticks)
{
    nlohmann::json sizes = nlohmann::json::array();
    for (const WorldSpec &spec : {WorldSpec{"gas", 100000}, {"gas", 500}, {"mix", 1000}, {"pile", 500}})
    {
        for (const SpaceKind kind :
             {SpaceKind::predictive, SpaceKind::predictive_by_shapes, SpaceKind::sweep_and_prune})
            sizes.push_back(measure({spec.name, std::min(spec.objects, objects)}, kind, std::min(ticks, 200)));
    }
    std::cout << "Bytes per geom: counted by the predictive space, and allocated in addition to the world without a "
                 "space\n\n";
    print_records(sizes);
    const nlohmann::json growth = {measure_growth({"churn", std::min(1000, objects)}, ticks)};
    std::cout << "Bytes counted by the predictive space, while geoms are created and destroyed\n\n";
    print_records(growth);
    sizes.push_back(growth[0]);
    return sizes;
}
} // namespace

int main(int argc, char **argv)
{
    int objects = 100000;
    int ticks = 1000000;
    const auto add_options = [&](CLI::App &app) {
        app.add_option("--n", objects, "Largest number of objects")
            ->check(CLI::Range(1, 1000000))
            ->capture_default_str();
        app.add_option("--ticks", ticks, "Ticks of the world churn; the others have at most 200")
            ->check(CLI::Range(1, 100000000))
            ->capture_default_str();
    };
    return run_program(argc, argv, "Measures the memory of a space per geom", add_options,
                       [&] { return measure_all(objects, ticks); });
}
