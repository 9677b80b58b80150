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

/// A geom that the probe can meet soon, by the space's prediction.
struct Encounter
{
    dGeomID geom = nullptr; ///< owned by the space
    /// s; from now to the earliest possible proximity; 0: near now. Two geoms are near when their bounding boxes
    /// overlap or, with dPredictiveProximityShape, when their shapes may touch.
    double seconds = 0;
};

/// Binds a device to an ODE world. The hand moves a geom of the scene and gets the forces of the touched objects; their
/// bodies get exactly the opposite.
///
/// A program needs one line in its near callback, and two around its dSpaceCollide():
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
/// HapticLoop does this at a fixed rate with supervision. Any space is possible; see TouchSensor.
///
/// For one thread, unless stated otherwise. Errors of the device cause zero force and a notice, never an exception.
/// Destroy the probe before its world, space, geom, tool and device, and after its loop has ended. Destroying it ends a
/// loop in another thread and waits for it; in its own loop's callbacks it terminates the program, without force and
/// with a message.
class HapticProbe
{
public:
    /// Makes a probe with its own sphere.
    ///
    /// @param device opened unless it is open; not owned.
    /// @param space of the sphere; not owned.
    /// @param radius m, > 0.
    /// @throws DeviceError, std::invalid_argument: see Renderer and TouchSensor.
    HapticProbe(Device &device, dSpaceID space, double radius, RenderSettings settings = {});

    /// Makes a probe with a geom of the program, without a body; not owned.
    HapticProbe(Device &device, dGeomID geom, RenderSettings settings = {});

    /// Makes a probe with a dynamic body of the program, which a virtual coupling holds to the device. The program
    /// makes its contact joints, and touch() has no effect. The body is not owned; its destruction, or that of its
    /// world, causes zero force and a notice.
    HapticProbe(Device &device, dBodyID tool, const CouplingProperties &coupling, RenderSettings settings = {});

    ~HapticProbe();
    HapticProbe(const HapticProbe &) = delete;
    HapticProbe &operator=(const HapticProbe &) = delete;

    /// Sets the function that returns the material of a geom, or nothing for the law's. touch() calls it in every tick
    /// for each geom near the probe. It must not throw; it may be empty. No effect with a tool body.
    void set_materials(MaterialOf materials);

    /// Begins a tick: reads the device, and moves the geom.
    ///
    /// @param time s, simulated; not less than in the call before.
    void begin(double time) { begin(time, time); }

    /// Begins a tick with a separate time for the watchdog: see Renderer::read().
    void begin(double time, double clock_time);

    /// Notes a pair of the near callback, in any order.
    ///
    /// @return true for a pair of the probe: the program makes no contact joints for it.
    bool touch(dGeomID first, dGeomID second);

    /// Writes the force, and adds the reactions to the bodies. Before the world is stepped by dt; touched bodies must
    /// exist.
    ///
    /// @param dt s, > 0.
    void render(double dt);

    /// The geoms that the probe can meet next, soonest first, as of the last dSpaceCollide(); empty without a geom in a
    /// predictive space. The cost grows with the number of geoms in the space.
    ///
    /// @return valid until the next call.
    const std::vector<Encounter> &encounters();

    /// Sets the time (s) from one dSpaceCollide() to the next, as render() does with its dt.
    void set_tick_length(double seconds);

    /// The last rendered tick.
    const RenderedTick &last_tick() const;

    /// The present touches, between the collision and the next begin(); empty with a tool body.
    const std::vector<Touch> &touches() const;

    /// The state of the tool in the scene.
    const ToolState &tool() const;

    /// The probe's geom; 0 with a tool body, and after its space was destroyed.
    dGeomID geom() const;

    /// Sets a function that each render() calls at its end, or an empty one.
    void set_recorder(std::function<void(const RenderedTick &)> recorder);

    /// The parts, for loops of two threads.
    Renderer &renderer();
    /// The sensor, for loops of two threads; 0 with a tool body.
    TouchSensor *sensor();

    /// The dynamic body that the virtual coupling holds to the device. 0 for a probe without one, and after its destruction.
    dBodyID tool_body() const;

    /// Takes the probe for a loop. From any thread.
    ///
    /// @throws std::logic_error when another loop runs it.
    void take(std::shared_ptr<ActiveRun> run);
    /// Gives the probe back, for a loop. From any thread.
    void give_back() noexcept;
    /// Whether a loop has the probe. From any thread.
    bool is_taken() const;

    /// Moves the sensor's geom to the tool, for loops. Not with a tool body.
    void place(const RenderedTick &tick);

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};
} // namespace ode_predictive_space::haptics

#endif
