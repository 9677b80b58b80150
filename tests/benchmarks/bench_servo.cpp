// Haptic loops at their rate, by the wall clock: do they keep up with 10,000 objects at 1 kHz, and with a separate servo at 4 kHz?

#include "demos/worlds/spaces.h"
#include "ode_predictive_space/haptics/hand_path.h"
#include "ode_predictive_space/haptics/loop/time_histogram.h"
#include "tests/benchmarks/results.h"

namespace
{
using namespace ode_predictive_space;
using namespace ode_predictive_space::benchmarks;
using namespace ode_predictive_space::worlds;

constexpr double probe_radius = 0.2;     // metres
constexpr double half_of_workspace = 1;  // in the scene, metres
constexpr double warm_up_seconds = 0.05; // of ticks before the loop
constexpr double moving = 0.1;           // share of the objects
constexpr std::uint64_t seed = 1;

struct Rates
{
    double servo;   ///< Hz
    double physics; ///< Hz; if it is not the servo's, the servo has its own thread

    bool decoupled() const { return physics != servo; }
};

haptics::RenderSettings render_settings()
{
    haptics::RenderSettings settings;
    settings.placement.scale = half_of_workspace / haptics::HandPathSettings().half_workspace;
    return settings;
}

/// A gas with a probe in its middle that a hand moves. Objects are moved between the ticks, as by a program with given paths.
class ServoScene
{
public:
    ServoScene(const std::string &space, int objects)
        : factory_({"gas", objects, seed, moving}), space_(make_space(space, factory_)),
          objects_(factory_.make(space_.get())), device_({}, seed),
          probe_(device_, space_.get(), probe_radius, render_settings())
    {}

    haptics::HapticProbe &probe() { return probe_; }
    haptics::SceneWork work();
    void warm_up();

    haptics::TimeHistogram
        collide_and_force;            ///< s per scene step: with the probe's contacts and, unless decoupled, the force
    std::uint64_t steps_in_touch = 0; ///< scene steps with a contact of the probe
    std::uint64_t pairs = 0;          ///< reported by the space

private:
    static void near(void *scene, dGeomID first, dGeomID second)
    {
        auto &self = *static_cast<ServoScene *>(scene);
        ++self.pairs;
        self.probe_.touch(first, second);
    }
    void collide() { dSpaceCollide(space_.get(), this, &near); }

    WorldFactory factory_;
    OwnedSpace space_; // outlives its content
    std::unique_ptr<World> objects_;
    haptics::HandPathDevice device_;
    haptics::HapticProbe probe_;
    haptics::MonotonicClock clock_;
    double started_ = 0; // s; when the current step began to collide
};

haptics::SceneWork ServoScene::work()
{
    haptics::SceneWork work;
    work.collide = [this] {
        started_ = clock_.now();
        collide();
        steps_in_touch += probe_.touches().empty() ? 0 : 1;
    };
    work.advance = [this](double) {
        collide_and_force.add(clock_.now() - started_);
        objects_->advance();
    };
    return work;
}

// Runs until the space has learned how the objects move. The probe does not move.
void ServoScene::warm_up()
{
    for (int tick = 0; tick < warm_up_seconds * 1000; ++tick)
    {
        objects_->advance();
        collide();
    }
    pairs = 0;
}

nlohmann::json measure(const std::string &space, int objects, const Rates &rates, double seconds)
{
    ServoScene scene(space, objects);
    scene.warm_up();
    haptics::LoopSettings settings;
    settings.rate = rates.servo;
    settings.decoupled = rates.decoupled();
    settings.physics_rate = rates.physics;
    settings.duration = seconds;
    haptics::HapticLoop loop(scene.probe(), settings);
    const haptics::LoopReport report = loop.run(scene.work());
    const haptics::TimeSummary collide_and_force = scene.collide_and_force.summary();
    const double late =
        static_cast<double>(report.overruns) / static_cast<double>(std::max<std::uint64_t>(1, report.ticks));
    return {{"table", "servo"},
            {"space", space},
            {"n", objects},
            {"moving", moving},
            {"seed", seed},
            {"rate_hz", rates.servo},
            {"decoupled", rates.decoupled()},
            {"ticks", report.ticks},
            {"share_in_time", 1 - late},
            {"servo_mean_us", 1e6 * report.compute.mean},
            {"servo_p50_us", 1e6 * report.compute.p50},
            {"servo_p99_us", 1e6 * report.compute.p99},
            {"servo_p999_us", 1e6 * report.compute.p999},
            {"collide_and_force_mean_us", 1e6 * collide_and_force.mean},
            {"collide_and_force_p50_us", 1e6 * collide_and_force.p50},
            {"collide_and_force_p999_us", 1e6 * collide_and_force.p999},
            {"period_p99_us", 1e6 * report.period.p99},
            {"period_max_us", 1e6 * report.period.max},
            {"real_time_factor", report.real_time_factor},
            {"steps_in_touch", scene.steps_in_touch},
            {"pairs", scene.pairs}};
}

void measure_in_spaces(const char *title, int objects, const Rates &rates, double seconds, nlohmann::json &all)
{
    nlohmann::json records = nlohmann::json::array();
    // A space that does not keep up runs many times longer than the time that it simulates.
    for (const std::string space : {"predictive-box", "hash", "quadtree", "sap"})
        records.push_back(measure(space, objects, rates, space == "predictive-box" ? seconds : seconds / 8));
    std::cout << title << "\n\n";
    print_records(records);
    all.insert(all.end(), records.begin(), records.end());
}

nlohmann::json measure_all(double seconds, int objects)
{
    nlohmann::json all = nlohmann::json::array();
    measure_in_spaces("Single-threaded at 1,000 Hz", objects, {1000, 1000}, seconds, all);
    for (const int size : {100, 1000, 10000})
        measure_in_spaces("The servo in its own thread at 4,000 Hz, the scene at 250 Hz", std::min(size, objects),
                          {4000, 250}, seconds, all);
    return all;
}
} // namespace

int main(int argc, char **argv)
{
    double seconds = 10;
    int objects = 10000;
    const auto add_options = [&](CLI::App &app) {
        app.add_option("--seconds", seconds, "Seconds of each loop")
            ->check(CLI::Range(0.01, 1000.0))
            ->capture_default_str();
        app.add_option("--n", objects, "Largest number of objects")
            ->check(CLI::Range(1, 1000000))
            ->capture_default_str();
    };
    return run_program(argc, argv, "Measures haptic loops that run at their rate, by the wall clock", add_options,
                       [&] { return measure_all(seconds, objects); });
}
