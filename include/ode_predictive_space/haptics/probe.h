// A haptic device in any ODE world.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PROBE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PROBE_H

#include "ode_predictive_space/haptics/renderer.h"
#include "ode_predictive_space/haptics/touch_sensor.h"

#include <functional>
#include <memory>
#include <vector>

namespace ode_predictive_space::haptics
{
class ActiveRun;

/// Something that the probe can meet soon, by the space's prediction.
struct Encounter
{
    dGeomID geom = nullptr; ///< owned by the space
    /// From now to the earliest time at which it can be near; 0: it is near now. Near are two whose bounding boxes overlap, or
    /// with dPredictiveProximityShape, whose shapes may touch.
    double seconds = 0;
};

/// Binds a device to an ODE world. The hand moves a geom of the scene, feels what that touches, and pushes it back: the touched
/// bodies get exactly the opposite of what the hand gets.
///
/// A program needs one line in its near callback, and three around what it does anyway:
///
///     void near(void *data, dGeomID a, dGeomID b)
///     {
///         if (probe.touch(a, b)) return;
///         ...                                      // as before
///     }
///     probe.begin(time);                           // read the device, place the geom
///     dSpaceCollide(space, 0, &near);              // as before
///     probe.render(dt);                            // law, reactions on the bodies, safety, write to the device
///     dWorldStep(world, dt);                       // as before
///
/// HapticLoop does this at a fixed rate, and watches over it. Any space will do; see TouchSensor.
///
/// All from one thread, but where it says otherwise. Errors of the device end with zero force and a notice, never with an
/// exception. Destroy the probe before its world, its space, its geom, its tool and its device, and after its loop has ended. A probe
/// that is destroyed while a loop of another thread runs it ends that loop and waits for it; in its own loop's callbacks this
/// cannot be, and the program is terminated, without force and with a message.
class HapticProbe
{
public:
    /// The probe is a sphere of its own.
    ///
    /// @param device is opened unless it is open; not owned.
    /// @param space where the sphere is to be; not owned.
    /// @param radius m, > 0.
    /// @throws DeviceError, std::invalid_argument: see Renderer and TouchSensor.
    HapticProbe(Device &device, dSpaceID space, double radius, RenderSettings settings = {});

    /// The probe is a geom of the program, without a body; not owned.
    HapticProbe(Device &device, dGeomID geom, RenderSettings settings = {});

    /// The probe is a dynamic body of the program, which a virtual coupling holds to the device. It touches things as any body
    /// does, by contact joints that the program makes: touch() has nothing to do. The body is not owned; when it is destroyed, or its
    /// world, there is no force any more, and a notice.
    HapticProbe(Device &device, dBodyID tool, const CouplingProperties &coupling, RenderSettings settings = {});

    ~HapticProbe();
    HapticProbe(const HapticProbe &) = delete;
    HapticProbe &operator=(const HapticProbe &) = delete;

    /// What each geom is made of; what the function leaves open is the law's. It is asked in the near callback for each geom that the probe
    /// may touch, in every tick. It must not throw. Empty: all is the law's. Not with a tool body.
    void set_materials(MaterialOf materials);

    /// A tick begins: read the device, place the geom there.
    ///
    /// @param time s, simulated; not less than in the call before.
    void begin(double time) { begin(time, time); }

    /// The same where simulated time is not the time by which the watchdog goes: see Renderer::read().
    void begin(double time, double clock_time);

    /// For the near callback; the order of the two does not matter.
    ///
    /// @return true when the pair has been dealt with: the program makes no contact joints for it.
    bool touch(dGeomID first, dGeomID second);

    /// Force on the hand, reactions on the bodies: before the world is stepped by dt. A touched body must live until then.
    ///
    /// @param dt s, > 0.
    void render(double dt);

    /// What the probe can meet next, soonest first, as of the last dSpaceCollide(); nothing where the geom is not in a predictive
    /// space or there is no geom. Each question looks at all geoms of the space.
    ///
    /// @return valid until the next call.
    const std::vector<Encounter> &encounters();

    /// s; how much time passes from one dSpaceCollide() to the next. render() sets it to its dt; for loops that do without.
    void set_tick_length(double seconds);

    /// What was rendered last.
    const RenderedTick &last_tick() const;

    /// What is touched now, between the collision and the next begin(). Nothing with a tool body.
    const std::vector<Touch> &touches() const;

    /// The probe in the scene.
    const ToolState &tool() const;

    /// 0 with a tool body, and when it was destroyed with its space.
    dGeomID geom() const;

    /// Called at the end of each render(): for recordings. Empty: nothing.
    void set_recorder(std::function<void(const RenderedTick &)> recorder);

    /// The parts, for loops that run them in different threads. The sensor is 0 with a tool body.
    Renderer &renderer();
    /// The same.
    TouchSensor *sensor();

    /// For the same: 0 without a tool body, and when that was destroyed.
    dBodyID tool_body() const;

    /// For the same: a loop takes the probe, and gives it back. From any thread.
    ///
    /// @throws std::logic_error when another loop runs it.
    void take(std::shared_ptr<ActiveRun> run);
    /// The same.
    void give_back() noexcept;
    /// Whether a loop has it.
    bool is_taken() const;

    /// For the same: the sensor's geom goes to the tool. Not with a tool body.
    void place(const RenderedTick &tick);

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};
} // namespace ode_predictive_space::haptics

#endif
