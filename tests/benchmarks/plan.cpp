// What a comparison is to be made of.

#include "tests/benchmarks/comparison.h"

#include "demos/runs/table.h"
#include "tests/benchmarks/contenders/contenders.h"

#include <algorithm>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr int quick_share = 5;
constexpr double quick_seconds_each = 0.4;
constexpr int most_objects_to_weigh_quickly = 1000;

/// With more objects than this a contender is not to be waited for: a tick takes seconds (brute, simple), its table gigabytes
/// (hash, n^2 / 8 bytes), its first tick (quadtree) or its filling and emptying (bullet-sap) minutes.
int most_objects(const std::string &contender)
{
    if (contender == "brute")
    {
        return 1000;
    }
    if (contender == "simple")
    {
        return 5000;
    }
    return contender == "hash" || contender == "quadtree" || contender == "bullet-sap" ? 20000 : 1000000;
}
} // namespace

Plan plan_for(const WorldSpec &spec, const std::vector<std::string> &contenders, int ticks, const Options &options)
{
    Plan plan;
    plan.spec = spec;
    plan.spec.seed = options.seed;
    plan.contenders = options.spaces.empty() ? contenders : options.spaces;
    plan.ticks = options.ticks.value_or(options.quick ? std::max(1, ticks / quick_share) : ticks);
    plan.seconds_each = options.quick ? quick_seconds_each : unlimited;
    plan.check = options.check;
    plan.weigh = !options.json_file.empty() && (!options.quick || spec.objects <= most_objects_to_weigh_quickly);
    return plan;
}

std::vector<std::string> fast_enough(const std::vector<std::string> &contenders, const WorldSpec &spec,
                                     Findings &findings)
{
    std::vector<std::string> result;
    for (const std::string &name : contenders)
    {
        if (spec.objects <= most_objects(name))
        {
            result.push_back(name);
            continue;
        }
        findings.note(spec.name + " " + grouped(static_cast<std::uint64_t>(spec.objects)) + ", without " + name +
                      ": too slow or too large with so many");
    }
    return result;
}

const std::vector<std::string> &ode_spaces()
{
    static const std::vector<std::string> names = {"simple", "hash", "quadtree", "sap"};
    return names;
}
} // namespace ode_predictive_space::benchmarks
