#include "tests/benchmarks/servo_measurement.h"

#include "demos/worlds/world.h"
#include "ode_predictive_space/haptics/hand_path.h"
#include "ode_predictive_space/haptics/loop/time_histogram.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr double servo_probe_radius = 0.2; // metres
constexpr double half_of_workspace = 1;    // in the scene, metres
constexpr double warm_up_seconds = 0.05;   // of ticks before the loop

haptics::RenderSettings render_settings()
{
    haptics::RenderSettings settings;
    settings.placement.scale = half_of_workspace / haptics::HandPathSettings().half_workspace;
    return settings;
}

class ServoScene
{
public:
    ServoScene(SpaceKind kind, const ServoSettings &settings)
        : spec_{"gas", settings.objects, settings.seed, settings.moving}, space_(make_space(kind, WorldFactory(spec_))),
          objects_(WorldFactory(spec_).make(space_.get())), device_({}, settings.seed),
          probe_(device_, space_.get(), servo_probe_radius, render_settings())
    {}

    haptics::HapticProbe &probe() { return probe_; }
    haptics::SceneWork work(haptics::LoopClock &clock);
    void warm_up();

    haptics::TimeHistogram collide_and_force;
    std::uint64_t steps_in_touch = 0;
    std::uint64_t pairs = 0;

private:
    static void near(void *scene, dGeomID first, dGeomID second)
    {
        auto &self = *static_cast<ServoScene *>(scene);
        ++self.pairs;
        self.probe_.touch(first, second);
    }
    void collide() { dSpaceCollide(space_.get(), this, &near); }

    WorldSpec spec_;
    OwnedSpace space_; // outlives its content
    std::unique_ptr<World> objects_;
    haptics::HandPathDevice device_;
    haptics::HapticProbe probe_;
    double started_ = 0; // s; when the current step began to collide
};

haptics::SceneWork ServoScene::work(haptics::LoopClock &clock)
{
    haptics::SceneWork work;
    work.collide = [this, &clock] {
        started_ = clock.now();
        collide();
        steps_in_touch += probe_.touches().empty() ? 0 : 1;
    };
    work.advance = [this, &clock](double) {
        collide_and_force.add(clock.now() - started_);
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
} // namespace

double ServoResult::share_in_time() const
{
    return report.ticks == 0 ? 0 : 1 - static_cast<double>(report.overruns) / static_cast<double>(report.ticks);
}

ServoResult run_servo(SpaceKind kind, const ServoSettings &settings)
{
    haptics::MonotonicClock machine;
    haptics::LoopClock &clock = settings.clock != nullptr ? *settings.clock : machine;
    ServoScene scene(kind, settings);
    scene.warm_up();
    haptics::LoopSettings loop_settings;
    loop_settings.rate = settings.rate;
    loop_settings.decoupled = settings.decoupled;
    loop_settings.physics_rate = settings.decoupled ? settings.physics_rate : settings.rate;
    loop_settings.duration = settings.seconds;
    loop_settings.clock = &clock;
    haptics::HapticLoop loop(scene.probe(), loop_settings);
    ServoResult result;
    result.space = kind;
    result.report = loop.run(scene.work(clock));
    result.collide_and_force = scene.collide_and_force.summary();
    result.steps_in_touch = scene.steps_in_touch;
    result.pairs = scene.pairs;
    return result;
}

nlohmann::json servo_record(const ServoResult &result, const ServoSettings &settings)
{
    const haptics::LoopReport &report = result.report;
    return {{"table", "servo"},
            {"space", space_name(result.space)},
            {"n", settings.objects},
            {"moving", settings.moving},
            {"seed", settings.seed},
            {"rate_hz", settings.rate},
            {"decoupled", settings.decoupled},
            {"ticks", report.ticks},
            {"share_in_time", result.share_in_time()},
            {"servo_mean_us", 1e6 * report.compute.mean},
            {"servo_p50_us", 1e6 * report.compute.p50},
            {"servo_p99_us", 1e6 * report.compute.p99},
            {"servo_p999_us", 1e6 * report.compute.p999},
            {"collide_and_force_mean_us", 1e6 * result.collide_and_force.mean},
            {"collide_and_force_p50_us", 1e6 * result.collide_and_force.p50},
            {"collide_and_force_p999_us", 1e6 * result.collide_and_force.p999},
            {"period_p99_us", 1e6 * report.period.p99},
            {"period_max_us", 1e6 * report.period.max},
            {"real_time_factor", report.real_time_factor},
            {"steps_in_touch", result.steps_in_touch},
            {"pairs", result.pairs}};
}
} // namespace ode_predictive_space::benchmarks
