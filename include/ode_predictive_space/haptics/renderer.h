// The hand's side of a probe: from the device to the tool, from touches to the device.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RENDERER_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RENDERER_H

#include "ode_predictive_space/haptics/delay_meter.h"
#include "ode_predictive_space/haptics/device_gate.h"
#include "ode_predictive_space/haptics/device_motion.h"
#include "ode_predictive_space/haptics/force_shares.h"
#include "ode_predictive_space/haptics/notice.h"
#include "ode_predictive_space/haptics/passivity.h"
#include "ode_predictive_space/haptics/safety.h"
#include "ode_predictive_space/haptics/stability.h"
#include "ode_predictive_space/haptics/virtual_coupling.h"
#include "ode_predictive_space/haptics/watchdog.h"
#include "ode_predictive_space/haptics/workspace.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace ode_predictive_space::haptics
{
class ContactManifold;

/// How a device is rendered to.
struct RenderSettings
{
    std::shared_ptr<ForceLaw>
        law; ///< 0: ProxyLaw with what is half of the device's stiffness in the hand, 500 N/m if that is not known
    WorkspacePlacement placement;          ///< of the device's workspace in the scene
    std::optional<SafetyLimits> safety;    ///< nothing: SafetyLimits::of() the device
    double rate = 1000;                    ///< Hz; how often the device is read and written
    double physics_rate = 1000;            ///< Hz; how often the scene is stepped
    std::optional<double> device_damping;  ///< N s/m; of device and hand, where it is known: see check_stability()
    std::optional<double> delay;           ///< s; as Capabilities::delay, where it is known better than by the device
    std::optional<unsigned> clutch_button; ///< which of the device's buttons moves the workspace instead of the tool
    bool passivity_control = false; ///< whether a PassivityController adds damping when energy comes from nowhere
    NoticeSink notice;              ///< what to do with messages; by default nothing
};

/// What was rendered in a tick: for recordings, and for who wants to show it.
struct RenderedTick
{
    double time = 0;                  ///< s; as given
    ToolState tool;                   ///< the scene's frame
    DeviceState state;                ///< the device's frame; as read, or before when it was not
    Wrench wrench;                    ///< the device's frame; as written
    Vector3 wished = Vector3::Zero(); ///< N, the scene's frame; what the law gave
    Vector3 force = Vector3::Zero();  ///< N, the scene's frame; what the hand got of it
    double allowance = 0;             ///< 0 to 1; the watchdog's
    bool device_answers = false;      ///< what it told is in its range and not too old
    bool saturated = false;           ///< the safety stage had to shorten the force
    int tool_jumps = 0;               ///< how often the tool was put elsewhere by more than the hand's motion
};

/// Device, workspace, law, safety, watchdog: all that needs no scene. Used from one thread, the servo's; nothing in it
/// allocates or locks as long as the device answers.
///
/// Errors of the device never leave it: there is zero force, a notice, and the device is tried again ten times a second. One that
/// does not even take the zero is closed; the program may open it again at any time between two ticks.
class Renderer
{
public:
    /// Opens the device unless it is open. What the law wants to be stiffer than check_stability() allows is rendered softer, with a notice.
    ///
    /// @param device is not owned, and must outlive the renderer.
    /// @throws DeviceError as Device::open() does.
    /// @throws std::logic_error when another renderer has the device.
    /// @throws std::invalid_argument for a law, a setting or a rate with which nothing sensible can be rendered.
    Renderer(Device &device, RenderSettings settings);

    /// Leaves the device with zero force, and closes it if it was opened here.
    ~Renderer();
    Renderer(const Renderer &) = delete;
    Renderer &operator=(const Renderer &) = delete;

    /// A tick begins: read the device. Then tool() is where the tool is now.
    ///
    /// @param time s; simulated. Devices without hardware, law and safety stage go by it.
    /// @param clock_time s; on the clock that physics_fresh() has, too: the watchdog goes by it.
    void read(double time, double clock_time);

    /// Where the tool is since the last read().
    const ToolState &tool() const { return tick_.tool; }

    /// Render what is touched, with the law.
    ///
    /// @param all_known whether the touches are all there are: false when one of them is not a number. Then there is no force.
    /// @param dt s from this tick to the next, > 0.
    void render(const std::vector<Touch> &touches, bool all_known, double dt);

    /// What the hand really got of each object in the last render(): N, the scene's frame. The sum is the force that was
    /// written, whatever limits shortened it, as long as something is touched. An object that was left may still be in it:
    /// the force that the safety stage takes away slowly belongs to it. Empty when there was no force.
    const std::vector<ForceShare> &shares() const { return split_.shares(); }

    /// Render a coupling to a tool body, as stiff as the device can.
    ///
    /// @return what the body is to get: the opposite of what the hand really got, in the scene's frame. A torque that the device
    ///         cannot render is not felt, but still turns the body.
    Wrench render(const VirtualCoupling &coupling, const ToolState &body, double dt);

    /// No force, now: at the end. The next force comes slowly, as at the start. Calls nothing but the device.
    void relax() noexcept;

    /// The scene's state is as of the last read().
    void note_fresh_physics() { physics_fresh(clock_time_); }

    /// The scene's state is as of this time, on the watchdog's clock. From any thread.
    void physics_fresh(double clock_time) { watchdog_->physics_fresh(clock_time); }

    /// Of the servo: the tick that was rendered last.
    const RenderedTick &last_tick() const { return tick_; }

    /// The default law is another one after set_placement().
    ForceLaw &law() { return *law_; }

    /// What the device can render of a material of the scene: the same, or with less stiffness or damping. This is what the law gets
    /// with each touch, as scale and rate are now.
    Material rendered(const Material &material) const;

    /// Between two ticks: another law, after check_stability().
    /// @throws std::invalid_argument as the constructor does.
    void set_law(std::shared_ptr<ForceLaw> law);

    /// s; from a position to the force that answers it, beyond the loop's own period: what the settings say, or else the device; or
    /// more, if the time stamps of its states are older. What is stiff depends on it.
    double delay() const;

    /// For virtual couplings, as set_law() for laws: says what render() makes softer.
    void check(const VirtualCoupling &coupling);

    /// What the device can render of a coupling, as scale and rate are now.
    VirtualCoupling softened(VirtualCoupling coupling) const;

    /// Between two ticks; the force comes back slowly. @throws std::invalid_argument as the constructor does: what is stiff depends
    /// on the scale.
    void set_placement(const WorkspacePlacement &placement);
    /// Between the device's frame and the scene's.
    const WorkspaceMapping &mapping() const { return mapping_; }

    /// Between two ticks: how often the device is read and written, and the scene is stepped, in Hz.
    /// @throws std::invalid_argument as the constructor does: what is stiff depends on the rate.
    void set_rates(double rate, double physics_rate);

    /// Called at the end of each render(). Empty: nothing.
    void set_recorder(std::function<void(const RenderedTick &)> recorder) { recorder_ = std::move(recorder); }

    /// Where notices go; in the thread of the call that has something to tell.
    void set_notice_sink(NoticeSink sink) { settings_.notice = std::move(sink); }
    /// The same.
    const NoticeSink &notice_sink() const { return settings_.notice; }

    /// What the safety stage did in the last tick and so far.
    const SafetyReport &safety_report() const { return safety_.report(); }

    /// Tell now what was held back because it had just been told: at the end of a run.
    void tell_held_back();

    /// How many notices were held back, so far. Those of a second are told as one, with their number.
    std::uint64_t held_back() const { return held_back_; }

    /// For the guard of a loop.
    DeviceGate &gate() { return gate_; }

private:
    enum class Topic; ///< of notices: each is told once a second at most

    /// Open as long as this lives, or for longer if it was open before.
    class Opening
    {
    public:
        explicit Opening(Device &device);
        ~Opening();
        Opening(const Opening &) = delete;
        Opening &operator=(const Opening &) = delete;

    private:
        Device &device_;
        bool opened_;
    };

    void check_law();
    void check(double stiffness, double damping);
    Rendering rendering(double stiffness, double damping) const;
    void feel(const std::vector<Touch> &touches, double dt);
    bool read_device(double time);
    bool is_silent(const DeviceState &state, double time);
    void follow(DeviceState state);
    void come_back();
    void fail(std::string_view why);
    void doubt(std::string_view why);
    void release_device() noexcept;
    void begin_anew();
    void move_clutch();
    void measure_delay(double age);
    Wrench write(const Wrench &wished, double dt);
    Wrench limited(const Wrench &wished, double dt);
    Wrench delivered(const Wrench &safe);
    void close_tick(const Vector3 &wished, const Vector3 &force);
    void tell_of_safety();
    void tell_of_watchdog();
    void tell_once_a_second(Topic topic, NoticeKind kind, std::string_view sentence);
    void tell_what_was_held_back(double quiet_for);
    void tell(NoticeKind kind, std::string_view sentence) const;

    /// Known to what takes the force away when the program ends.
    class Registration
    {
    public:
        explicit Registration(DeviceGate &gate);
        ~Registration();
        Registration(const Registration &) = delete;
        Registration &operator=(const Registration &) = delete;

    private:
        DeviceGate &gate_;
    };

    DeviceGate gate_;
    Opening opening_;
    Registration registration_;
    RenderSettings settings_; ///< its law is 0 as long as that is the default
    WorkspaceMapping mapping_;
    std::shared_ptr<ForceLaw> law_;
    SafetyStage safety_;
    std::optional<Watchdog> watchdog_; ///< always there: made anew when the rates change
    std::optional<PassivityController> passivity_;
    std::function<void(const RenderedTick &)> recorder_;

    bool answers_ = false;
    bool failed_ = false;      ///< and has not answered since
    bool guard_acted_ = false; ///< since the last tick
    double doubted_since_;     ///< s, simulated; since when the device tells nonsense, if it does
    bool relaxed_ = false;     ///< and has not been read since
    double next_try_;          ///< s, simulated; when a device that failed is tried again
    double last_news_ = 0;     ///< s, simulated; when the device's state was a new one
    double last_state_time_;   ///< s; of the last state, by the device
    double clock_time_ = 0;
    double last_answer_;      ///< s, simulated; of the device
    std::vector<Touch> felt_; ///< touches with the materials that are rendered
    std::unique_ptr<ContactManifold> manifold_;
    DeviceMotion motion_;
    DelayMeter delay_meter_;
    TouchForces forces_;
    ForceSplit split_;
    RenderedTick tick_;
    WatchdogReason last_reason_ = WatchdogReason::none;
    std::string stability_told_; ///< why the law is rendered softer; empty when it is not

    /// What was told of a topic, and what was not.
    struct Told
    {
        double last;   ///< s, simulated; when it was told
        int times = 0; ///< held back since
        Notice notice; ///< the last of those
    };

    static constexpr std::size_t most_topics = 20;
    std::array<Told, most_topics> told_;
    std::uint64_t held_back_ = 0;
};
} // namespace ode_predictive_space::haptics

#endif
