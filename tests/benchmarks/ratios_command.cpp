// predictive_bench ratios: how many times as fast the predictive space is as the best of ODE's, and as Bullet's.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"

#include "demos/runs/table.h"
#include "tests/benchmarks/contenders/contenders.h"

#include <algorithm>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr double most_seconds_per_ratio = 10;
constexpr int short_warm_up = 30; ///< of scenes with contacts, whose slow contenders else would have no tick in common
constexpr double times_as_fast_as_bullet = 3;

enum class Bullet
{
    left_out,
    beside, ///< takes part
    asked   ///< and P10 asks how much faster the predictive space is
};

/// A scene, and how many times as fast as the best of ODE's spaces the predictive one is to be in it.
struct RatioCase
{
    const char *line;
    const char *scene;
    int objects;
    double at_least; ///< 0: nothing is asked beside ODE's spaces
    Bullet bullet;
    double moving = -1; ///< share of the objects; < 0: the scene's own
    bool when_quick = true;
    double seconds_each = 0; ///< at least, also when quick
};

/// The ball of a stack is thrown every 400 ticks, and the boxes settle in between.
constexpr double seconds_for_stack = 2;

/// A hundred ticks of warm-up are over: until then many predictions are the first ones.
constexpr double seconds_for_very_many = 1.5;

constexpr RatioCase ratio_cases[] = {
    {"P2", "gas", 100, 6, Bullet::asked},
    {"P2", "gas", 1000, 25, Bullet::asked},
    {"P2", "gas", 10000, 80, Bullet::asked},
    {"P2", "gas", 100000, 500, Bullet::beside, 0.1, true, seconds_for_very_many},
    {"P3", "game", 100, 4, Bullet::asked},
    {"P3", "game", 1000, 8, Bullet::asked},
    {"P3", "game", 10000, 18, Bullet::asked},
    {"P4", "pile", 100, 0, Bullet::asked},
    {"P4", "pile", 500, 4, Bullet::left_out},
    {"P4", "pile", 1000, 0, Bullet::asked},
    {"P4", "pile", 2000, 4, Bullet::left_out},
    {"P4", "pile", 10000, 0, Bullet::asked, -1, false},
    {"P4", "stack", 1000, 4, Bullet::left_out, -1, true, seconds_for_stack},
    {"P5", "still", 10000, 100, Bullet::left_out},
    {"P8", "terrain", 5000, 5, Bullet::left_out},
    {"P8", "churn", 10000, 5, Bullet::left_out},
};

/// Enough for a steady mean.
int ticks_of(const RatioCase &one)
{
    // Nearly all of a tick of a pile is the step of the world, and one is like the other.
    if (one.scene == std::string("pile"))
    {
        return 1500;
    }
    if (one.objects < objects_for_single_ticks)
    {
        return 20000;
    }
    return one.objects <= 1000 ? 5000 : (one.objects <= 10000 ? 1000 : 100);
}

std::string title(const RatioCase &one)
{
    return std::string(one.scene) + " " + grouped(static_cast<std::uint64_t>(one.objects)) +
           (one.moving >= 0 ? ", " + fixed(100 * one.moving, 0) + " % moving" : "");
}

/// There a floor, which knows the pairs from a copy of its own that is ahead, takes another step of the world for each tick.
bool has_contacts(const RatioCase &one)
{
    return one.scene == std::string("pile") || one.scene == std::string("stack");
}

std::vector<std::string> contenders(const RatioCase &one)
{
    std::vector<std::string> names;
    for (const std::string &name : contender_names())
    {
        const bool left_out = name == "brute" || (is_bullet(name) && one.bullet == Bullet::left_out) ||
                              (is_floor(name) && has_contacts(one) && one.objects >= objects_for_single_ticks);
        if (!left_out)
        {
            names.push_back(name);
        }
    }
    return names;
}

void require(const RatioCase &one, const Comparison &comparison, Findings &findings)
{
    const Result *ours = comparison.find("predictive-box");
    const Result *best = comparison.best_of_ode();
    if (ours == nullptr)
    {
        return;
    }
    if (best != nullptr && one.at_least > 0)
    {
        findings.require({one.line, title(one) + ", best ODE (" + best->name + ") over ours",
                          comparison.ratio(*best, *ours), Requirement::at_least, one.at_least, "x"});
    }
    for (const char *bullet : {"bullet-dbvt", "bullet-sap"})
    {
        const Result *other = one.bullet == Bullet::asked ? comparison.find(bullet) : nullptr;
        if (other != nullptr)
        {
            findings.require({"P10", title(one) + ", " + bullet + " over ours", comparison.ratio(*other, *ours),
                              Requirement::at_least, times_as_fast_as_bullet, "x"});
        }
    }
}

void measure_case(const RatioCase &one, const Options &options, Findings &findings)
{
    const WorldSpec spec{one.scene, one.objects, options.seed, one.moving};
    Plan plan = plan_for(spec, fast_enough(contenders(one), spec, findings), ticks_of(one), options);
    plan.seconds_each = std::min(std::max(plan.seconds_each, one.seconds_each), most_seconds_per_ratio);
    plan.warm_up_ticks = has_contacts(one) ? short_warm_up : plan.warm_up_ticks;
    require(one, *compare_once(plan, findings), findings);
}

class RatiosCommand : public Command
{
public:
    std::string name() const override { return "ratios"; }
    std::string description() const override
    {
        return "How many times as fast the predictive space is as the best of ODE's, and as Bullet, scene by scene";
    }

    void measure(const Options &options, Findings &findings) override
    {
        if (!have_bullet)
        {
            findings.note("without Bullet, which was not there to build with: P10 was not measured");
        }
        for (const RatioCase &one : ratio_cases)
        {
            if (options.objects.value_or(one.objects) != one.objects)
            {
                continue;
            }
            if (options.quick && !one.when_quick)
            {
                findings.note(title(one) + " was left out, as it takes too long to prepare for a quick run");
                continue;
            }
            measure_case(one, options, findings);
        }
    }
};
} // namespace

std::unique_ptr<Command> make_ratios_command()
{
    return std::make_unique<RatiosCommand>();
}
} // namespace ode_predictive_space::benchmarks
