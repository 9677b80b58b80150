// predictive_bench scene NAME: one scene, several contenders.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"

#include <CLI/CLI.hpp>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

class SceneCommand : public Command
{
public:
    std::string name() const override { return "scene"; }
    std::string description() const override { return "Run one scene in several spaces"; }

    void add_options(CLI::App &command) override
    {
        command.add_option("name", spec_.name, describe_all())
            ->required()
            ->check(CLI::IsMember(world_names(Group::scene)));
        command.add_option("--moving", spec_.moving, "Share of the objects that move, in gas and churn (default 0.5)")
            ->check(CLI::Range(0.0, 1.0));
    }

    void measure(const Options &options, Findings &findings) override
    {
        spec_.objects = options.objects.value_or(1000);
        std::vector<std::string> contenders = {"predictive-box"};
        contenders.insert(contenders.end(), ode_spaces().begin(), ode_spaces().end());
        const Comparison comparison =
            compare(plan_for(spec_, fast_enough(contenders, spec_, findings), 1000, options), findings);
        print(std::cout, comparison);
        record(comparison, findings);
    }

private:
    static std::string describe_all()
    {
        std::string text = "One of:";
        for (const std::string &name : world_names(Group::scene))
        {
            text += "\n  " + name + ": " + world_named(name).text;
        }
        return text;
    }

    WorldSpec spec_;
};
} // namespace

std::unique_ptr<Command> make_scene_command()
{
    return std::make_unique<SceneCommand>();
}
} // namespace ode_predictive_space::benchmarks
