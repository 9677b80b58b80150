#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_HAPTIC_RUN_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_HAPTIC_RUN_H

#include "demos/haptic/demo_device.h"
#include "demos/haptic/encounter_log.h"
#include "demos/haptic/haptic_scene.h"
#include "demos/haptic/options.h"
#include "demos/haptic/servo_log.h"
#include "ode_predictive_space/haptics/loop.h"

#include <optional>

namespace ode_predictive_space::demo
{
using haptics::Vector3;

struct RunResult
{
    std::string law; ///< its name
    haptics::LoopReport loop;
    SceneTotals scene;
    ServoTotals servo;
    double step_seconds = 0;                    ///< simulated, of a value in the scene's series
    double servo_seconds = 0;                   ///< simulated, of a value in the servo's series
    std::optional<EncounterSummary> encounters; ///< in a predictive space
    std::vector<LoggedContact> contacts;
    std::optional<haptics::ForceError> replay_error; ///< of a replay: against the recorded forces
    std::uint64_t replayed_ticks = 0;                ///< number of compared ticks
    double stiffness = 0;                            ///< N/m, at the hand; at the end
    double scale = 1;                                ///< metres of the scene per metre of the hand
    std::size_t lost_in_recording = 0;               ///< ticks
    std::uint64_t safety_notices = 0;                ///< of the guard and the watchdog
};

/// Inputs of the person; any thread may set them.
struct RunControl
{
    std::atomic<bool> paused{false};  ///< the scene is paused, the probe is not
    std::atomic<double> stiffness{0}; ///< N/m, at the hand
};

/// Scene, probe and loop, created for each run. Unless noted, all functions are for the thread that calls run(), and for
/// the function that run() calls after each step.
class HapticRun
{
public:
    static constexpr double probe_radius = worlds::object_radius; ///< m

    /// @param factory makes the scene without a probe.
    /// @throws exceptions derived from std::exception when a part cannot be created.
    HapticRun(const Options &options, const worlds::WorldFactory &factory, DemoDevice &device, RunControl &control,
              const haptics::NoticeSink &notice);
    ~HapticRun();
    HapticRun(const HapticRun &) = delete;
    HapticRun &operator=(const HapticRun &) = delete;

    /// @param after_step called after each step of the scene; may be empty. Can be called once.
    RunResult run(const std::function<void()> &after_step = {});

    void stop() { loop_->stop(); }                                 ///< from any thread
    haptics::LoopReport report() const { return loop_->report(); } ///< from any thread
    ServoLog &servo_log() { return *servo_log_; }

    const HapticScene &scene() const { return scene_; }
    const Vector3 &start() const { return start_; } ///< m; where the probe begins: in free space
    dGeomID probe_geom() const { return probe_->geom(); }
    const haptics::RenderedTick &rendered() const { return loop_->latest(); }
    const std::vector<dGeomID> &touched() const { return touched_; } ///< in the last step
    const std::vector<haptics::Encounter> &meetings() const { return meetings_; }
    double max_force() const { return device_.capabilities().max_force; } ///< N
    double max_stiffness() const { return max_stiffness_; }               ///< N/m, at the hand
    double servo_rate() const;                                            ///< Hz
    bool decoupled() const;

private:
    void make_probe(const haptics::NoticeSink &notice);
    void make_adjustable();
    void make_loop(const haptics::NoticeSink &notice);
    haptics::WorkspacePlacement place_hand();
    void follow_contacts();
    void compare_with_recording();

    const Options &options_;
    DemoDevice &device_;
    RunControl &control_;
    HapticScene scene_;
    Vector3 start_ = Vector3::Zero(); ///< m
    double max_stiffness_ = 0;        ///< N/m, at the hand
    std::vector<dGeomID> touched_;
    std::vector<haptics::Encounter> meetings_;
    EncounterLog encounter_log_;
    RunResult result_; ///< without what is known at the end only
    std::optional<ServoLog> servo_log_;
    std::atomic<std::uint64_t> safety_notices_{0}; ///< added to by the guard's thread and the servo's
    haptics::SimulatedClock simulated_clock_;
    std::unique_ptr<haptics::HapticProbe> probe_;
    std::unique_ptr<haptics::HapticLoop> loop_;
};
} // namespace ode_predictive_space::demo

#endif
