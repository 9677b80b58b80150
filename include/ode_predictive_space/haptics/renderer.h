// The hand's side of a probe: from the device to the tool, from touches to the device.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RENDERER_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RENDERER_H

#include "ode_predictive_space/haptics/force_law.h"
#include "ode_predictive_space/haptics/safety.h"
#include "ode_predictive_space/haptics/workspace.h"

#include <functional>
#include <memory>
#include <optional>

namespace ode_predictive_space::haptics
{
class DeviceGate;

/// How a device is rendered to.
struct RenderSettings
{
    /// 0: ProxyLaw with what is half of the device's stiffness in the hand, 500 N/m if that is not known.
    std::shared_ptr<ForceLaw> law;
    WorkspacePlacement placement;          ///< of the device's workspace in the scene
    std::optional<SafetyLimits> safety;    ///< nothing: SafetyLimits::of() the device
    double rate = 1000;                    ///< Hz; how often the device is read and written
    double physics_rate = 1000;            ///< Hz; how often the scene is stepped
    std::optional<double> device_damping;  ///< N s/m; of device and hand, where it is known: see check_stability()
    std::optional<double> delay;           ///< s; as Capabilities::delay, where it is known better than by the device
    std::optional<unsigned> clutch_button; ///< which of the device's buttons moves the workspace instead of the tool
    bool passivity_control = false;        ///< whether damping is added when energy comes from nowhere
    NoticeSink notice;                     ///< what to do with messages; by default nothing
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
    const ToolState &tool() const;

    /// Render what is touched, with the law.
    ///
    /// @param all_known whether the touches are all there are: false when one of them is not a number. Then there is no force.
    /// @param dt s from this tick to the next, > 0.
    void render(const std::vector<Touch> &touches, bool all_known, double dt);

    /// What the hand really got of each object in the last render(): N, the scene's frame. The sum is the force that was
    /// written, whatever limits shortened it, as long as something is touched. An object that was left may still be in it:
    /// the force that the safety stage takes away slowly belongs to it. Empty when there was no force.
    const std::vector<ForceShare> &shares() const;

    /// Render a coupling to a tool body, as stiff as the device can.
    ///
    /// @return what the body is to get: the opposite of what the hand really got, in the scene's frame. A torque that the device
    ///         cannot render is not felt, but still turns the body.
    Wrench render(const CouplingProperties &coupling, const ToolState &body, double dt);

    /// No force, now: at the end. The next force comes slowly, as at the start. Calls nothing but the device.
    void relax() noexcept;

    /// The scene's state is as of the last read().
    void note_fresh_physics();

    /// The scene's state is as of this time, on the watchdog's clock. From any thread.
    void physics_fresh(double clock_time);

    /// Of the servo: the tick that was rendered last.
    const RenderedTick &last_tick() const;

    /// The default law is another one after set_placement().
    ForceLaw &law();

    /// What the device can render of a material of the scene: the same, or with less stiffness or damping. This is what the law gets
    /// with each touch, as scale and rate are now.
    Material rendered(const Material &material) const;

    /// Between two ticks: another law, after check_stability().
    /// @throws std::invalid_argument as the constructor does.
    void set_law(std::shared_ptr<ForceLaw> law);

    /// For virtual couplings, as set_law() for laws: says what render() makes softer.
    /// @throws std::invalid_argument when a property is negative or not finite, or the damping cannot be rendered.
    void check(const CouplingProperties &coupling);

    /// Between two ticks; the force comes back slowly. @throws std::invalid_argument as the constructor does: what is stiff depends
    /// on the scale.
    void set_placement(const WorkspacePlacement &placement);

    /// The device's base has moved in the scene, and the tool with it, as if the hand had carried it there: what the tool meets on the way
    /// holds it, and clutch and grip stay. From the scene's thread, once per step. The servo takes the base there within the time of a
    /// step of the scene, evenly.
    ///
    /// @param motion with which it moves; zero from the last call on.
    /// @throws std::invalid_argument as the constructor does, and when a scale is not that of set_placement().
    void move_base(const WorkspacePlacement &placement, const BaseMotion &motion);

    /// Between the device's frame and the scene's.
    const WorkspaceMapping &mapping() const;

    /// Between two ticks: how often the device is read and written, and the scene is stepped, in Hz.
    /// @throws std::invalid_argument as the constructor does: what is stiff depends on the rate.
    void set_rates(double rate, double physics_rate);

    /// Called at the end of each render(). Empty: nothing.
    void set_recorder(std::function<void(const RenderedTick &)> recorder);

    /// Where notices go; in the thread of the call that has something to tell.
    void set_notice_sink(NoticeSink sink);
    /// The same.
    const NoticeSink &notice_sink() const;

    /// For the guard of a loop.
    DeviceGate &gate();

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};
} // namespace ode_predictive_space::haptics

#endif
