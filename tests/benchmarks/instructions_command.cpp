// predictive_bench instructions: what a busy machine does not change.

#include "demos/worlds/world.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/instructions/counted_run.h"
#include "tests/benchmarks/scene_choice.h"

#include "demos/runs/table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <dlfcn.h>
#include <fstream>
#include <iostream>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

struct CountedCase
{
    std::string scene;
    int objects;
    int warm_up_ticks; ///< what is new in a space has settled by then
    int ticks;
    int lives = 0;  ///< not 0: what is made and destroyed so often; that is counted, too
    int period = 1; ///< ticks from one that is counted to the next
};

/// In a simulated processor a tick of the slow spaces takes seconds.
constexpr int many_objects = 5000;
constexpr int most_objects_for_ode = 50000;

constexpr int lives = 10; // they are all the same

std::string title(const CountedCase &one)
{
    return one.scene + " " + grouped(static_cast<std::uint64_t>(one.objects));
}

const std::vector<CountedCase> &counted_cases()
{
    static const std::vector<CountedCase> all = {
        {"mix", 40, 200, 1000},        {"gas", 100, 200, 1000},    {"gas", 1000, 100, 500},
        {"gas", 10000, 100, 300},      {"gas", 100000, 60, 20},    {"game", 100, 200, 1000},
        {"game", 1000, 100, 300},      {"game", 10000, 50, 20},    {"pile", 500, 50, 100},
        {"stack", 1000, 100, 400}, // the ball is thrown once
        {"terrain", 5000, 50, 100},    {"teleport", 10, 100, 500}, {"teleport", 100, 50, 200},
        {"teleport", 1000, 50, 100},   {"still", 10000, 20, 100},  {"dart", 1000, 50, 100},
        {"explosion", 1000, 100, 400}, // two of them
    };
    return all;
}

/// Of a heap's fall the first half second, and of its rest what follows 1.5 s.
const std::vector<CountedCase> &world_cases()
{
    static const std::vector<CountedCase> all = {
        {"floor", 100, 100, 200},
        {"floor", 500, 100, 100},
        {"floor", 2000, 50, 20},
        {"floor_50", 500, 100, 100},
        {"ragdolls", 20, 100, 100},
        {"chain", 1, 100, 300},
        {"shelves", 1000, 50, 50},
        {"shelves", 10000, 20, 10},
        {"shelves_mesh", 1000, 50, 50},
        {"shelves_mesh", 10000, 20, 10},
        {"heap", 100, 0, 100},
        {"heap", 500, 0, 100},
        {"heap", 2000, 0, 100},
        {"heap_lies", 100, 300, 100},
        {"heap_lies", 500, 300, 50},
        {"heap_lies", 2000, 300, 20},
        {"heap_50", 500, 0, 100},
        {"drones", 300, 50, 100},
        {"drones", 1000, 50, 30},
        {"room", 1000, 250, 30}, // the tree of the room is ready by then
        {"hills", 1000, 250, 30},
        {"city", 100, 50, 50},
        {"rain", 1000, 100, 100},
        {"frames_0", 1000, 100, 40},
        {"frames_20", 1000, 100, 40},
        {"frames_50", 1000, 100, 40},
        {"frames_80", 1000, 100, 40},
        {"frames_set_0", 1000, 100, 40},
        {"frames_set_20", 1000, 100, 40},
        {"frames_set_50", 1000, 100, 40},
        {"frames_set_80", 1000, 100, 40},
        {"many", 2, 0, ticks_of_life, lives},
        {"many", 8, 0, ticks_of_life, lives},
        {"many", 17, 0, ticks_of_life, lives},
        {"many", 32, 0, ticks_of_life, lives},
        {"nested", 22, 50, 100},
        {"nested_empty", 100, 10, 20},
        {"lidar", 1000, 3, 2},
        {"lidar_nested", 1000, 3, 2},
        {"moon", 200, 100, 100},
        {"reset", 100, ticks_between_events, 3, 0, ticks_between_events},
        {"reset_1", 100, ticks_between_events + 1, 3, 0, ticks_between_events},
        {"reset_2", 100, ticks_between_events + 2, 3, 0, ticks_between_events},
        {"recentre", 1000, ticks_between_events, 3, 0, ticks_between_events},
        {"recentre_1", 1000, ticks_between_events + 1, 3, 0, ticks_between_events},
        {"recentre_2", 1000, ticks_between_events + 2, 3, 0, ticks_between_events},
        {"conveyor", 200, 60, 60},
        {"first", 1000, 0, 1},
        {"first_1", 1000, 1, 1},
        {"first_2", 1000, 2, 1},
    };
    return all;
}

/// Of whole ticks, from the first one on: what a program needs that runs so long.
const std::vector<CountedCase> &whole_cases()
{
    static const std::vector<CountedCase> all = {
        {"mix", 100, 0, 200}, {"mix", 1000, 0, 200}, {"pile", 500, 0, 100}, {"stack", 1000, 0, 200}};
    return all;
}

/// What the command line can name.
std::vector<CountedCase> all_cases(bool whole)
{
    std::vector<CountedCase> all = whole ? whole_cases() : counted_cases();
    all.insert(all.end(), world_cases().begin(), world_cases().end());
    return all;
}

/// Where the functions come from that are counted.
std::string which_library()
{
    Dl_info library{};
    return dladdr(reinterpret_cast<const void *>(&dPredictiveSpaceCreate), &library) != 0 ? library.dli_fname
                                                                                          : "an unknown file";
}

class InstructionsCommand : public Command
{
public:
    explicit InstructionsCommand(bool whole) : whole_(whole) {}

    std::string name() const override { return "instructions"; }
    std::string description() const override
    {
        return "Instructions per tick, counted by callgrind: the same on a busy machine";
    }

    void add_options(CLI::App &command) override
    {
        command.footer(
            "Counted are dSpaceCollide(), with a callback that only notes the pair, and the notices: what "
            "geoms that move\n"
            "cost beyond the same motion in a space that is never collided. Each scene runs once per space "
            "under valgrind's\n"
            "callgrind (Debian's package valgrind), with a motion that is made outside of it. Two runs of "
            "the same program on\n"
            "the same machine give the same numbers. To compare two versions of the library, run one "
            "program with each of\n"
            "them in LD_LIBRARY_PATH: the first time with --json FILE, then with --against FILE.\n"
            "With --whole the scene runs under callgrind, too, and counted are whole ticks: motion with the step "
            "of the world,\n"
            "dSpaceCollide(), dCollide() and contact joints.");
        command.add_option("--scenes", scenes_, "Scenes, or scenes and sizes, separated by commas: stack,gas:1000")
            ->delimiter(',');
        command.add_option("--warm-up", warm_up_ticks_, "Ticks before those that are counted")
            ->check(CLI::Range(0, 100000000));
        command.add_flag("--worlds", worlds_, "Count in the worlds of `predictive_bench worlds`");
        command.add_flag("--cache-sim", caches_, "Count data misses in simulated caches, too");
        command.add_option("--lives", lives_)->group(""); // for --make-ticks
        auto *whole =
            command.add_flag("--whole", whole_, "Count whole ticks, and dSpaceCollide() and dCollide() in them");
        command.add_option("--against", earlier_file_, "Compare with what an earlier run wrote with --json")
            ->type_name("FILE")
            ->check(CLI::ExistingFile)
            ->excludes(whole);
        command.add_flag("--make-ticks", make_ticks_)->group(""); // what this program starts under callgrind
    }

    void measure(const Options &options, Findings &findings) override
    {
        if (make_ticks_)
        {
            const CountedRun run = run_of(chosen_cases().front(), options.spaces.front(), options);
            findings.record(whole_ ? make_whole_ticks(run) : make_counted_ticks(run));
            return;
        }
        std::cout << "Counted in " << which_library() << "\n\n" << std::flush;
        if (whole_)
        {
            measure_whole_ticks(options, findings);
            return;
        }
        std::vector<Count> counts;
        for (const CountedCase &one : chosen_cases())
        {
            if (options.objects.value_or(one.objects) == one.objects)
            {
                count_case(one, options, counts, findings);
            }
        }
        print(std::cout, counts);
        for (const Count &count : counts)
        {
            findings.record(record_of(count));
        }
        if (!earlier_file_.empty())
        {
            compare_with_earlier(counts, findings);
        }
    }

private:
    std::vector<CountedCase> chosen_cases() const
    {
        if (!scenes_.empty())
        {
            return chosen(all_cases(whole_), scenes_);
        }
        return worlds_ ? world_cases() : whole_ ? whole_cases() : counted_cases();
    }

    CountedRun run_of(const CountedCase &one, const std::string &space, const Options &options) const
    {
        CountedRun run;
        run.spec = {one.scene, one.objects, options.seed};
        run.space = space == "predictive" ? space_name(SpaceKind::predictive) : space;
        run.warm_up_ticks = warm_up_ticks_.value_or(one.warm_up_ticks);
        run.ticks = options.ticks.value_or(one.ticks);
        run.period = one.period;
        run.whole = whole_;
        run.lives = lives_.value_or(one.lives);
        run.caches = caches_;
        return run;
    }

    static std::vector<std::string> without_floors(std::vector<std::string> names, Findings &findings)
    {
        const auto end = std::remove_if(names.begin(), names.end(), &is_floor);
        if (end != names.end())
        {
            findings.note("without floors, which know the pairs only of scenes that they run themselves");
            names.erase(end, names.end());
        }
        return names;
    }

    static std::vector<std::string> spaces(const CountedCase &one, const Options &options, Findings &findings)
    {
        if (!options.spaces.empty())
        {
            return without_floors(options.spaces, findings);
        }
        if (one.objects >= most_objects_for_ode)
        {
            findings.note(title(one) + ": without ODE's spaces, which take minutes there");
            return {"predictive-box"};
        }
        if (one.objects >= many_objects)
        {
            findings.note(title(one) + ": without simple and hash, which are far from the best there");
            return {"predictive-box", "quadtree", "sap"};
        }
        std::vector<std::string> names = {"predictive-box"};
        if (one.scene.find("lidar") == 0)
        {
            names.emplace_back("predictive-sphere"); // which decides rays by slabs
        }
        names.insert(names.end(), ode_spaces().begin(), ode_spaces().end());
        return names;
    }

    void count_case(const CountedCase &one, const Options &options, std::vector<Count> &counts,
                    Findings &findings) const
    {
        const WorldFactory factory = factory_of(run_of(one, "", options));
        std::string expected_hash;
        for (const std::string &space : spaces(one, options, findings))
        {
            std::cerr << "instructions: " << title(one) << " in " << space << '\n';
            counts.push_back(count_instructions(run_of(one, space, options), factory));
            if (!is_exact(space))
            {
                continue;
            }
            const std::string &hash = counts.back().pair_hash;
            expected_hash = expected_hash.empty() ? hash : expected_hash;
            if (hash != expected_hash)
            {
                std::cerr << "THE CONTENDERS DISAGREE: they did not report the same pairs\n";
                findings.fail(exit_wrong_pairs);
            }
        }
    }

    static bool is_exact(const std::string &space)
    {
        return space != "predictive-sphere" && space != "predictive-shape";
    }

    void measure_whole_ticks(const Options &options, Findings &findings) const
    {
        const std::vector<std::string> usual = {"predictive-box", "predictive-shape", "quadtree", "sap"};
        const auto names = without_floors(options.spaces.empty() ? usual : options.spaces, findings);
        std::vector<WholeCount> counts;
        for (const CountedCase &one : chosen_cases())
        {
            for (const std::string &space : names)
            {
                if (options.objects.value_or(one.objects) == one.objects)
                {
                    std::cerr << "instructions of whole ticks: " << title(one) << " in " << space << '\n';
                    counts.push_back(count_whole_ticks(run_of(one, space, options)));
                    findings.record(record_of(counts.back()));
                }
            }
        }
        print(std::cout, counts);
        if (!same_states(counts))
        {
            std::cerr << "THE CONTENDERS DISAGREE: they did not all come to the same contacts\n";
            findings.fail(exit_wrong_pairs);
        }
        require_whole_ticks(counts, findings);
    }

    static void require_whole_ticks(const std::vector<WholeCount> &counts, Findings &findings)
    {
        const WholeCount *boxes = find(counts, "mix", 1000, "predictive-box");
        const WholeCount *shapes = find(counts, "mix", 1000, "predictive-shape");
        if (boxes == nullptr || shapes == nullptr || shapes->ticks != 200 || shapes->warm_up_ticks != 0)
        {
            return;
        }
        findings.require({"P17", "mix 1,000, collide and dCollide in the first 200 ticks",
                          shapes->both() * shapes->ticks / 1e6, Requirement::at_most, 41, "M instructions"});
        findings.require({"P17", "mix 1,000, whole ticks, predictive-shape / predictive-box",
                          shapes->whole / boxes->whole, Requirement::at_most, 0.78, "x"});
    }

    void compare_with_earlier(const std::vector<Count> &counts, Findings &findings) const
    {
        const std::vector<CountPair> pairs =
            in_both(counts_in(nlohmann::json::parse(std::ifstream(earlier_file_))), counts);
        print(std::cout, pairs);
        const bool same =
            std::all_of(pairs.begin(), pairs.end(), [](const CountPair &pair) { return pair.same_pairs(); });
        if (!same)
        {
            std::cerr << "THE RUNS DISAGREE: they did not report the same pairs\n";
            findings.fail(exit_wrong_pairs);
        }
    }

    std::vector<std::string> scenes_;
    std::optional<int> warm_up_ticks_;
    std::string earlier_file_;
    bool whole_;
    bool worlds_ = false;
    bool caches_ = false;
    std::optional<int> lives_;
    bool make_ticks_ = false;
};
} // namespace

std::unique_ptr<Command> make_instructions_command(bool whole)
{
    return std::make_unique<InstructionsCommand>(whole);
}
} // namespace ode_predictive_space::benchmarks
