// The hand's side of a probe: reads the device, and renders touches.

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

/// Settings of a renderer.
struct RenderSettings
{
    /// 0: ProxyLaw with half of the device's stiffness in the hand, or 500 N/m.
    std::shared_ptr<ForceLaw> law;
    WorkspacePlacement placement;          ///< of the device's workspace in the scene
    std::optional<SafetyLimits> safety;    ///< default: SafetyLimits::of() the device
    double rate = 1000;                    ///< Hz; of reads and writes of the device
    double physics_rate = 1000;            ///< Hz; of steps of the scene
    std::optional<double> device_damping;  ///< N s/m; of device and hand, if known: see check_stability()
    std::optional<double> delay;           ///< s; replaces Capabilities::delay
    std::optional<unsigned> clutch_button; ///< button that moves the workspace instead of the tool
    bool passivity_control = false;        ///< adds damping when energy is created (Hannaford and Ryu, 2002)
    NoticeSink notice;                     ///< sink of notices; may be empty
};

/// The result of a tick, for recordings and displays.
struct RenderedTick
{
    double time = 0;                     ///< s; as given
    ToolState tool;                      ///< the scene's frame
    DeviceState state;                   ///< device's frame; last valid read
    Wrench wrench;                       ///< device's frame; as written
    Vector3 requested = Vector3::Zero(); ///< N, scene's frame; of the law
    Vector3 force = Vector3::Zero();     ///< N, scene's frame; the written part of it
    double allowance = 0;                ///< 0 to 1; the watchdog's
    bool device_answers = false;         ///< its state is plausible and not too old
    bool saturated = false;              ///< the safety stage clamped the force
    int tool_jumps = 0;                  ///< number of jumps of the tool beyond the hand's motion
};

/// Device, workspace, law, safety and watchdog: the parts without a scene. For one thread, the servo's; neither
/// allocates nor locks while the device answers.
///
/// Errors of the device cause zero force and a notice instead of an exception, and the device is tried again ten times
/// a second. A device that refuses zero is closed; the program may open it again between two ticks.
class Renderer
{
public:
    /// Opens the device unless it is open. A law that is stiffer than check_stability() allows is rendered softer, with
    /// a notice.
    ///
    /// @param device not owned; must outlive the renderer.
    /// @throws DeviceError as Device::open() does.
    /// @throws std::logic_error when another renderer has the device.
    /// @throws std::invalid_argument for a law, a setting or a rate that is not valid.
    Renderer(Device &device, RenderSettings settings);

    /// Sets zero force, and closes a device that was opened here.
    ~Renderer();
    Renderer(const Renderer &) = delete;
    Renderer &operator=(const Renderer &) = delete;

    /// Begins a tick: reads the device, and updates tool().
    ///
    /// @param time s; simulated, for simulated devices and the safety stage.
    /// @param clock_time s; on the watchdog's clock, which physics_fresh() uses, too.
    void read(double time, double clock_time);

    /// The tool in the scene, as of the last read().
    const ToolState &tool() const;

    /// Renders touches with the law.
    ///
    /// @param all_known false when a touch is missing because it is not finite, which causes zero force.
    /// @param dt s from this tick to the next, > 0.
    void render(const std::vector<Touch> &touches, bool all_known, double dt);

    /// Each object's part of the force that the last render() wrote, N, the scene's frame. The sum is the written
    /// force. A former object may be included while its force fades. Empty without a force.
    const std::vector<ForceShare> &shares() const;

    /// Renders a coupling to a tool body, limited by check_stability().
    ///
    /// @return the wrench on the body: the opposite of the written wrench, in the scene's frame, and the full torque
    ///         for a device without torque.
    Wrench render(const CouplingProperties &coupling, const ToolState &body, double dt);

    /// Sets zero force now. The next force is ramped, as at the start. Calls only the device.
    void relax() noexcept;

    /// Notes that the scene's state is as of the last read().
    void note_fresh_physics();

    /// Notes that the scene's state is as of this time (s), on the watchdog's clock. From any thread.
    void physics_fresh(double clock_time);

    /// The last rendered tick. For the servo's thread.
    const RenderedTick &last_tick() const;

    /// The law; set_placement() and set_rates() replace the default one.
    ForceLaw &law();

    /// The material with stiffness and damping limited to the device's, at the present scale and rate, as the law gets
    /// it.
    Material rendered(const Material &material) const;

    /// Replaces the law, after check_stability(). Between two ticks.
    /// @throws std::invalid_argument as the constructor does.
    void set_law(std::shared_ptr<ForceLaw> law);

    /// Checks a virtual coupling, with a notice if render() will make it softer.
    /// @throws std::invalid_argument when a property is negative or not finite, or the damping cannot be rendered.
    void check(const CouplingProperties &coupling);

    /// Replaces the placement; the force is ramped. Between two ticks. @throws std::invalid_argument as the constructor
    /// does, because stiffness depends on the scale.
    void set_placement(const WorkspacePlacement &placement);

    /// Moves the device's base in the scene, and the tool with it, as if the hand carried it: obstacles hold the tool,
    /// and clutch and grip are kept. For the scene's thread, once per step. The servo moves the base there evenly
    /// within a step of the scene.
    ///
    /// @param motion velocity of the base; zero in the last call.
    /// @throws std::invalid_argument as the constructor does, and for a scale that differs from that of
    ///         set_placement().
    void move_base(const WorkspacePlacement &placement, const BaseMotion &motion);

    /// The mapping between the frames of device and scene.
    const WorkspaceMapping &mapping() const;

    /// Sets the rates (Hz) of the device and of the scene. Between two ticks.
    /// @throws std::invalid_argument as the constructor does, because stiffness depends on the rate.
    void set_rates(double rate, double physics_rate);

    /// Sets a function that each render() calls at its end, or an empty one.
    void set_recorder(std::function<void(const RenderedTick &)> recorder);

    /// Sets the sink of notices, which is called in the thread of the call that sends one.
    void set_notice_sink(NoticeSink sink);
    /// The sink of notices; may be empty.
    const NoticeSink &notice_sink() const;

    /// The gate of the device, for the guard of a loop.
    DeviceGate &gate();

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};
} // namespace ode_predictive_space::haptics

#endif
