// What is behind a renderer.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RENDERER_PARTS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RENDERER_PARTS_H

#include "ode_predictive_space/haptics/contact/contact_manifold.h"
#include "ode_predictive_space/haptics/law/force_shares.h"
#include "ode_predictive_space/haptics/renderer.h"
#include "ode_predictive_space/haptics/safety/device_link.h"
#include "ode_predictive_space/haptics/safety/passivity.h"
#include "ode_predictive_space/haptics/safety/safety_stage.h"
#include "ode_predictive_space/haptics/safety/watchdog.h"

namespace ode_predictive_space::haptics
{
/// From the touches of a tick to the force that each object makes of them.
struct FeltTouches
{
    std::vector<Touch> touches; ///< with the materials that are rendered
    ContactManifold manifold;
    TouchForces forces; ///< N; by the law
    ForceSplit split;   ///< of what the hand got of them
};

class Renderer::Parts
{
public:
    Parts(Device &device, RenderSettings render_settings);

    /// A tick's reading.
    void restart();
    void take_in(const DeviceLink::News &news);
    void move_clutch();
    double delay() const { return std::max(settings.delay.value_or(link.capabilities().delay), link.measured_delay()); }
    void tell_of_delay();

    /// A tick's force.
    void feel(const std::vector<Touch> &touches, double dt);
    Wrench write(const Wrench &requested, double dt);
    Wrench limited(const Wrench &requested, double dt);
    void close_tick(const Vector3 &requested, const Vector3 &force);
    void tell_of_safety();
    void tell_of_watchdog();

    /// What the device can bear.
    void check_law() { check(law->material().stiffness, law->material().damping); }
    void check(double stiffness, double damping);
    Rendering rendering(double stiffness, double damping) const;
    Material rendered(const Material &material) const;

    RenderSettings settings; ///< its law is 0 as long as that is the default, its sink of notices is in the desk
    NoticeDesk notices;
    DeviceLink link;
    WorkspaceMapping mapping;
    std::shared_ptr<ForceLaw> law;
    SafetyStage safety;
    std::optional<Watchdog> watchdog; ///< always there: made anew when the rates change
    std::optional<PassivityController> passivity;
    std::function<void(const RenderedTick &)> recorder;
    FeltTouches felt;
    RenderedTick tick;
    double clock_time = 0;
    bool relaxed = false; ///< and has not been read since
    WatchdogReason last_reason = WatchdogReason::none;
    std::string stability_told; ///< why the law is rendered softer; empty when it is not
};
} // namespace ode_predictive_space::haptics

#endif
