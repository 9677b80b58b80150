// The process that starts callgrind and moves the scene.

#include "tests/benchmarks/instructions/counted_run.h"

#include "demos/runs/spaces.h"
#include "demos/worlds/world.h"
#include "tests/benchmarks/instructions/callgrind_output.h"
#include "tests/benchmarks/instructions/child_process.h"
#include "tests/benchmarks/instructions/motion_stream.h"
#include "tests/benchmarks/weight.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace ode_predictive_space::benchmarks
{
namespace
{
constexpr bool built_with_valgrind =
#ifdef ODE_PREDICTIVE_SPACE_HAVE_VALGRIND
    true;
#else
    false;
#endif

/// A folder that goes with this object.
class TemporaryFolder
{
public:
    TemporaryFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "predictive_bench_XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
        {
            throw std::system_error(errno, std::generic_category(), name);
        }
        path_ = name;
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder &) = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;

    std::string file(const char *name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

/// What the loader and the programs need, and nothing that differs from run to run: the environment lies on the stack and moves
/// it. All functions are bound at the start, not when they are first called.
std::vector<std::string> environment()
{
    std::vector<std::string> variables = {"LD_BIND_NOW=1"};
    for (const char *name : {"PATH", "LD_LIBRARY_PATH", "VALGRIND_LIB"})
    {
        const char *value = std::getenv(name);
        if (value != nullptr)
        {
            variables.push_back(std::string(name) + "=" + value);
        }
    }
    return variables;
}

std::vector<std::string> command_line(const CountedRun &run, const std::string &counts, const std::string &record)
{
    std::vector<std::string> line = {"valgrind",
                                     "--tool=callgrind",
                                     "--quiet",
                                     "--instr-atstart=no",
                                     "--collect-atstart=no",
                                     "--compress-strings=no",
                                     "--compress-pos=no",
                                     "--callgrind-out-file=" + counts,
                                     std::filesystem::read_symlink("/proc/self/exe").string(),
                                     "instructions",
                                     "--make-ticks",
                                     "--spaces=" + run.space,
                                     "--scenes=" + run.spec.name + ":" + std::to_string(run.spec.objects),
                                     "--seed=" + std::to_string(run.spec.seed),
                                     "--warm-up=" + std::to_string(run.warm_up_ticks),
                                     "--ticks=" + std::to_string(run.ticks),
                                     "--json=" + record};
    if (run.whole)
    {
        line.emplace_back("--whole");
    }
    if (run.lives > 0)
    {
        line.emplace_back("--lives=" + std::to_string(run.lives));
    }
    if (run.caches)
    {
        line.insert(line.begin() + 1, {"--cache-sim=yes"});
    }
    return line;
}

void pass_motion_on(const CountedRun &run, const worlds::WorldFactory &factory, ChildProcess &process)
{
    Recorder recorder(factory);
    write_moves(process.input(), recorder.start());
    for (int tick = 0; tick < run.ticks_to_make(); ++tick)
    {
        write_moves(process.input(), recorder.record(1).front());
    }
}

/// @param feed writes what the process is to read.
template <typename Feed> void run_callgrind(const std::vector<std::string> &arguments, Feed feed)
{
    if (!built_with_valgrind)
    {
        throw std::runtime_error("this program was built without valgrind's header; install the package valgrind and "
                                 "build it again");
    }
    bool succeeded = false;
    try
    {
        ChildProcess process(arguments, environment());
        feed(process);
        succeeded = process.finish();
    }
    catch (const std::system_error &failure)
    {
        throw std::runtime_error(failure.code() == std::errc::no_such_file_or_directory
                                     ? "valgrind was not found; Debian's package is named valgrind"
                                     : failure.what());
    }
    if (!succeeded)
    {
        throw std::runtime_error("the process under callgrind failed");
    }
}

/// Of one function, less those of the other, which is there to be subtracted.
struct CostsBeyond
{
    double instructions = 0;
    CacheMisses misses{};
};

class CostsPerTick
{
public:
    CostsPerTick(std::string file, double ticks) : file_(std::move(file)), ticks_(ticks) {}

    CostsBeyond of(const char *function) const
    {
        std::ifstream dump(file_);
        const Costs costs = costs_of_calls(dump, function);
        const auto per_tick = [this](std::uint64_t sum) { return static_cast<double>(sum) / ticks_; };
        return {per_tick(costs.instructions), {per_tick(costs.first_level_misses), per_tick(costs.last_level_misses)}};
    }

    CostsBeyond of_first_beyond_second(const char *first, const char *second) const
    {
        const CostsBeyond all = of(first), bare = of(second);
        return {all.instructions - bare.instructions,
                {all.misses.first_level - bare.misses.first_level, all.misses.last_level - bare.misses.last_level}};
    }

private:
    std::string file_;
    double ticks_;
};

CountedScene scene_of(const CountedRun &run)
{
    return {run.spec.name, run.spec.objects, run.spec.seed, run.warm_up_ticks, run.ticks, run.space};
}
/// Add up what belongs to the space.
double add_part(const CostsBeyond &part, Count &count)
{
    if (count.misses)
    {
        count.misses->first_level += part.misses.first_level;
        count.misses->last_level += part.misses.last_level;
    }
    return part.instructions;
}

void add_costs(const CostsPerTick &costs, bool with_life, Count &count)
{
    count.collide = add_part(costs.of("predictive_bench_counted_collide"), count);
    count.notices =
        add_part(costs.of_first_beyond_second("predictive_bench_counted_moves", "predictive_bench_bare_moves"), count);
    if (with_life)
    {
        count.life =
            costs.of_first_beyond_second("predictive_bench_counted_birth", "predictive_bench_bare_birth").instructions +
            costs.of_first_beyond_second("predictive_bench_counted_death", "predictive_bench_bare_death").instructions;
    }
}

} // namespace

worlds::WorldFactory factory_of(const CountedRun &run)
{
    return worlds::WorldFactory(run.lives > 0 ? worlds::life_of_many(run.spec) : run.spec);
}

Count count_instructions(const CountedRun &run, const worlds::WorldFactory &factory)
{
    const TemporaryFolder folder;
    const std::string counts = folder.file("counts");
    const std::string record = folder.file("record");
    run_callgrind(command_line(run, counts, record),
                  [&](ChildProcess &process) { pass_motion_on(run, factory, process); });

    Count count{scene_of(run)};
    count.misses = run.caches ? std::optional<CacheMisses>(CacheMisses()) : std::nullopt;
    add_costs(CostsPerTick(counts, static_cast<double>(run.ticks) * std::max(1, run.lives)), run.lives > 0, count);
    const nlohmann::json written = nlohmann::json::parse(std::ifstream(record)).at(0);
    count.pairs = written.at("pairs");
    count.pair_hash = written.at("pair_hash");
    if (run.lives > 0)
    {
        const double bytes = bytes_per_geom(run.space, factory);
        count.bytes_per_geom = std::isfinite(bytes) ? std::optional<double>(bytes) : std::nullopt;
    }
    return count;
}

WholeCount count_whole_ticks(const CountedRun &run)
{
    const TemporaryFolder folder;
    const std::string counts = folder.file("counts");
    const std::string record = folder.file("record");
    run_callgrind(command_line(run, counts, record), [](ChildProcess &) {});

    const auto per_tick = [&](const char *function) {
        std::ifstream dump(counts);
        return static_cast<double>(costs_of_any_calls(dump, function).value_or(Costs()).instructions) / run.ticks;
    };
    WholeCount count{scene_of(run)};
    count.collide = per_tick("predictive_bench_counted_collide");
    count.contacts = per_tick("dCollide");
    count.notices = per_tick("dGeomMoved");
    count.whole =
        count.collide + per_tick("predictive_bench_counted_advance") + per_tick("predictive_bench_counted_respond");
    const nlohmann::json written = nlohmann::json::parse(std::ifstream(record)).at(0);
    count.calls_per_tick = written.at("calls").get<double>() / run.ticks;
    count.contacts_per_tick = written.at("contacts").get<double>() / run.ticks;
    count.state_hash = written.at("state_hash");
    return count;
}
} // namespace ode_predictive_space::benchmarks
