// predictive_bench floor: how near the predictive space is to what cannot be undercut.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"

#include "demos/runs/table.h"

#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
constexpr int floor_objects = 10000;
constexpr int floor_ticks = 2500;
constexpr double most_times_the_floor = 2;

class FloorCommand : public Command
{
public:
    std::string name() const override { return "floor"; }
    std::string description() const override
    {
        return "The predictive space beside a loop that reads each moved position once and knows the pairs";
    }

    void measure(const Options &options, Findings &findings) override
    {
        const worlds::WorldSpec spec{"gas", options.objects.value_or(floor_objects)};
        Plan plan = plan_for(spec, {"predictive-box", "floor"}, floor_ticks, options);
        plan.seconds_each = worlds::unlimited;
        const Comparison comparison = compare(plan, findings);
        print(std::cout, comparison);
        record(comparison, findings);
        const Result *ours = comparison.find("predictive-box");
        const Result *floor = comparison.find("floor");
        if (ours != nullptr && floor != nullptr)
        {
            findings.require(
                {"P11", "gas " + worlds::grouped(static_cast<std::uint64_t>(spec.objects)) + ", time over the floor's",
                 comparison.ratio(*ours, *floor), Requirement::at_most, most_times_the_floor, "x"});
        }
    }
};
} // namespace

std::unique_ptr<Command> make_floor_command()
{
    return std::make_unique<FloorCommand>();
}
} // namespace ode_predictive_space::benchmarks
