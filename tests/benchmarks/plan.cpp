// What a comparison is to be made of.

#include "tests/benchmarks/comparison.h"

#include "demos/scenes/table.h"
#include "tests/benchmarks/contenders/contenders.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

constexpr int quick_share = 5;
constexpr double quick_seconds_each = 0.8;

/// More objects than this, and a single tick of it takes seconds, or gigabytes.
int most_objects(const std::string &contender)
{
    if (contender == "brute")
    {
        return 1000;
    }
    return contender == "simple" || contender == "hash" ? 20000 : 1000000;
}
} // namespace

Plan plan_for(const SceneSpec &spec, const std::vector<std::string> &contenders, int ticks, const Options &options)
{
    Plan plan;
    plan.spec = spec;
    plan.spec.seed = options.seed;
    plan.contenders = options.spaces.empty() ? contenders : options.spaces;
    plan.ticks = options.ticks.value_or(options.quick ? std::max(1, ticks / quick_share) : ticks);
    plan.seconds_each = options.quick ? quick_seconds_each : unlimited;
    plan.check = options.check;
    plan.weigh = !options.json_file.empty();
    return plan;
}

std::vector<std::string> fast_enough(const std::vector<std::string> &contenders, const SceneSpec &spec,
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
        findings.note(spec.name + ", n = " + grouped(static_cast<std::uint64_t>(spec.objects)) + ", without " + name +
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
