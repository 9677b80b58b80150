// Records each dSpaceCollide() and dSpaceCollide2() of a world on its predictive space, for ode-predictive replay.

#include "demos/worlds/spaces.h"
#include "ode_predictive_space/recording/recorder.h"
#include "tests/benchmarks/rows.h"

#include <CLI/CLI.hpp>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

namespace
{
using namespace ode_predictive_space;
using namespace ode_predictive_space::worlds;
using recording::Recorder;

Recorder *recorder = nullptr; // null: nothing is recorded
std::size_t events = 0;       // number of recorded events

struct Call
{
    Recorder::Event event;
    void *data;
    dNearCallback *callback;

    static void near(void *call, dGeomID first, dGeomID second)
    {
        auto &self = *static_cast<Call *>(call);
        self.event.note(first, second);
        self.callback(self.data, first, second);
    }
};

template <typename Function> Function next_function(const char *name)
{
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}
} // namespace

// These definitions take precedence over ODE's in this program.
void dSpaceCollide(dSpaceID space, void *data, dNearCallback *callback)
{
    static const auto real = next_function<decltype(&dSpaceCollide)>("dSpaceCollide");
    if (recorder == nullptr)
        return real(space, data, callback);
    Call call = {recorder->begin_collide(space), data, callback};
    ++events;
    real(space, &call, &Call::near);
    call.event.end();
}

void dSpaceCollide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback)
{
    static const auto real = next_function<decltype(&dSpaceCollide2)>("dSpaceCollide2");
    if (recorder == nullptr)
        return real(first, second, data, callback);
    Call call = {recorder->begin_collide2(first, second), data, callback};
    ++events;
    real(first, second, &call, &Call::near);
    call.event.end();
}

namespace
{
/// All worlds of many are the same, so one of them is recorded.
WorldSpec recorded_spec(const WorldSpec &spec)
{
    return spec.name == "many" ? life_of_many(spec) : spec;
}

/// @return the number of the first event of each tick, and the one after the last.
std::vector<std::size_t> run(const WorldFactory &factory, int ticks)
{
    OwnedSpace space(make_space("predictive-box", factory));
    const std::unique_ptr<World> world = factory.make(space.get());
    PairList pairs;
    std::vector<std::size_t> first_events;
    for (int tick = 0; tick < ticks; ++tick)
    {
        world->advance();
        pairs.clear();
        first_events.push_back(events);
        world->collide(space.get(), &pairs, PairList::near);
        world->respond(pairs.sorted());
    }
    first_events.push_back(events);
    dSpaceSetCleanup(space.get(), 0); // the world destroys the geoms
    space.reset();
    return first_events;
}

int record(const WorldSpec &spec, int ticks, const std::string &path)
{
    recording::HistoryFile file(path, false);
    if (!file.is_open())
    {
        std::cerr << "record_worlds: " << path << " cannot be written: " << std::strerror(file.error()) << '\n';
        return 2;
    }
    Recorder writes(std::move(file), UINT64_MAX, "world " + spec.name + " " + std::to_string(spec.objects));
    recorder = &writes;
    const std::vector<std::size_t> first_events = run(WorldFactory(recorded_spec(spec)), ticks);
    recorder = nullptr;
    if (!writes.close())
    {
        std::cerr << "record_worlds: " << path << " could not be written to its end\n";
        return 2;
    }
    std::cout << nlohmann::json{{"first_events", first_events}} << '\n';
    return 0;
}

void list_rows()
{
    nlohmann::json list = nlohmann::json::array();
    for (const benchmarks::Row &row : benchmarks::rows())
    {
        const benchmarks::Ticks &ticks = row.counted;
        if (ticks.count > 0)
            list.push_back({{"scene", row.world},
                            {"n", row.objects},
                            {"group", world_named(row.world).group == Group::program ? "worlds" : "scenes"},
                            {"first", ticks.first},
                            {"ticks", ticks.count},
                            {"every", ticks.every},
                            {"to_make", ticks.to_make()}});
    }
    std::cout << list.dump(2) << '\n';
}

int run_as_asked(int argc, char **argv)
{
    CLI::App app("Records a world of demos/worlds in a predictive space, for ode-predictive replay. Prints, as JSON, "
                 "the number\n"
                 "of the first event of each tick.");
    WorldSpec spec;
    int ticks = 100;
    std::string path;
    bool list = false;
    app.add_flag("--list", list, "Print, as JSON, the worlds whose instructions are counted, and in which ticks");
    app.add_option("world", spec.name, "The world");
    app.add_option("n", spec.objects, "Number of objects")->check(CLI::Range(1, 1000000));
    app.add_option("--ticks", ticks, "Number of ticks")->check(CLI::Range(1, 100000000))->capture_default_str();
    app.add_option("--seed", spec.seed, "Seed of positions and motions")->capture_default_str();
    app.add_option("--output", path, "The file of the recording")->type_name("FILE");
    try
    {
        app.parse(argc, argv);
        if (!list && (spec.name.empty() || path.empty()))
            throw CLI::RequiredError("a world and --output, or --list");
    }
    catch (const CLI::ParseError &end)
    {
        return app.exit(end) == 0 ? 0 : 2;
    }
    if (list)
    {
        list_rows();
        return 0;
    }
    const OdeSession ode;
    return record(spec, ticks, path);
}
} // namespace

int main(int argc, char **argv)
{
    try
    {
        return run_as_asked(argc, argv);
    }
    catch (const std::exception &failure)
    {
        std::cerr << "record_worlds: " << failure.what() << '\n';
        return 2;
    }
}
