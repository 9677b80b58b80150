// predictive_bench all: every other subcommand that has something to say about the requirements.

#include "tests/benchmarks/commands.h"

#include "demos/runs/table.h"
#include "demos/runs/world_run.h"

#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
class AllCommand : public Command
{
public:
    explicit AllCommand(Commands parts) : parts_(std::move(parts)) {}

    std::string name() const override { return "all"; }
    std::string description() const override { return "All of the above, and which of the requirements are met"; }
    void measure(const Options &options, Findings &findings) override
    {
        Options of_parts = options;
        of_parts.objects.reset();
        of_parts.ticks.reset();
        of_parts.spaces.clear();
        const auto start = worlds::Clock::now();
        for (const auto &part : parts_)
        {
            const auto begin = worlds::Clock::now();
            std::cout << "===== " << part->name() << ": " << part->description() << "\n\n";
            part->measure(of_parts, findings);
            const double seconds = worlds::seconds_between(begin, worlds::Clock::now());
            std::cout << "(" << part->name() << " took " << worlds::fixed(seconds, 1) << " s)\n\n";
            std::cout.flush();
        }
        const double seconds = worlds::seconds_between(start, worlds::Clock::now());
        std::cout << "===== The requirements, measured in " << worlds::fixed(seconds, 0) << " s\n";
    }

private:
    Commands parts_;
};
} // namespace

std::unique_ptr<Command> make_all_command(Commands parts)
{
    return std::make_unique<AllCommand>(std::move(parts));
}
} // namespace ode_predictive_space::benchmarks
