#include "tests/benchmarks/weight.h"

#include "demos/runs/world_run.h"
#include "tests/benchmarks/contenders/contenders.h"

#include <limits>
#include <malloc.h>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr int ticks_to_fill = 3;

void report_nowhere(void *, dGeomID, dGeomID) {}

/// The heap's growth by a scene whose space keeps nothing of its own.
double weight_of_scene(const WorldFactory &factory)
{
    const std::size_t before = heap_in_use();
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    const std::unique_ptr<World> scene = factory.make(space.get());
    return static_cast<double>(heap_in_use()) - static_cast<double>(before);
}

/// The heap's growth by a contender with its scene, and by its first ticks.
double weight_with_scene(const Contender &contender, std::size_t heap_before, World &scene)
{
    double weight = static_cast<double>(heap_in_use()) - static_cast<double>(heap_before);
    for (int tick = 0; tick < ticks_to_fill; ++tick)
    {
        scene.advance();
        const std::size_t before = heap_in_use();
        dSpaceCollide(contender.space(), nullptr, &report_nowhere);
        weight += static_cast<double>(heap_in_use()) - static_cast<double>(before);
    }
    return weight;
}
} // namespace

std::optional<std::size_t> told_bytes(dSpaceID space)
{
    if (dSpaceIsPredictive(space) == 0)
    {
        return std::nullopt;
    }
    dPredictiveSpaceStats stats;
    dPredictiveSpaceGetStats(space, &stats);
    return stats.bytes;
}

std::size_t heap_in_use()
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

double bytes_per_geom(const std::string &name, const WorldFactory &factory)
{
    if (name == "hash" || name == "brute" || is_floor(name))
    {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const double scene_alone = weight_of_scene(factory);
    const std::size_t before = heap_in_use();
    const auto contender = benchmarks::make_contender(name, factory);
    const std::unique_ptr<World> scene = factory.make(contender->space());
    const double both = weight_with_scene(*contender, before, *scene);
    return (both - scene_alone) / dSpaceGetNumGeoms(contender->space());
}
} // namespace ode_predictive_space::benchmarks
