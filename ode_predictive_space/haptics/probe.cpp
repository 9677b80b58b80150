#include "ode_predictive_space/haptics/probe.h"

#include "ode_predictive_space/haptics/contact/body_watch.h"
#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/contact/mesh_store.h"
#include "ode_predictive_space/haptics/contact/ode_vector.h"
#include "ode_predictive_space/haptics/law/virtual_coupling.h"
#include "ode_predictive_space/haptics/safety/active_run.h"

#include <Eigen/Eigenvalues>
#include <ode/collision_space.h>
#include <ode/mass.h>
#include <ode/objects.h>
#include <ode_predictive_space/predictive_space.h>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ode_predictive_space::haptics
{
namespace
{
double smallest_inertia(const dMass &mass)
{
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia_of(mass), Eigen::EigenvaluesOnly)
        .eigenvalues()
        .minCoeff();
}

bool is_same(const CouplingProperties &a, const CouplingProperties &b)
{
    return a.stiffness == b.stiffness && a.damping == b.damping && a.angular_stiffness == b.angular_stiffness &&
           a.angular_damping == b.angular_damping;
}
} // namespace

class HapticProbe::Parts
{
public:
    Parts(Device &device, RenderSettings settings) : renderer(device, std::move(settings)) {}

    void render_tool_body(double dt)
    {
        if (const dBodyID body = tool_watch.find(tool))
        {
            const CouplingProperties possible = coupling_of(body, dt);
            const Wrench wrench = renderer.render(possible, as_held(tool_state_of(body)), dt);
            if (!wrench.force.isZero(0) || !wrench.torque.isZero(0))
                push_body(body, wrench.force, wrench.torque);
            return;
        }
        notify_of_loss("No force: the tool's body was destroyed.");
        renderer.render({}, true, dt);
    }

    CouplingProperties coupling_of(dBodyID body, double dt)
    {
        if (dBodyIsKinematic(body) != 0)
            return coupling;
        dMass mass;
        dBodyGetMass(body, &mass);
        const CouplingProperties possible =
            bounded(coupling, static_cast<double>(mass.mass), smallest_inertia(mass), dt);
        if (!is_same(possible, coupling))
            notify_once(notified_of_light_tool, NoticeKind::stability,
                        "The coupling is softer or less damped than requested, as the tool's body is too light.");
        return possible;
    }

    /// The body relative to its grip: its orientation at the start, or after a jump, counts as that of the handle.
    ToolState as_held(ToolState body)
    {
        if (!grip || tool_jumps != renderer.last_tick().tool_jumps)
        {
            tool_jumps = renderer.last_tick().tool_jumps;
            grip = renderer.tool().orientation.conjugate() * body.orientation;
        }
        body.orientation = body.orientation * grip->conjugate();
        return body;
    }

    void notify_if_gone()
    {
        if (sensor && sensor->is_gone())
            notify_of_loss(
                "No force: the probe's geom was destroyed with its space. Destroy the probe before the space.");
    }

    void notify_of_loss(std::string_view sentence) { notify_once(notified_of_loss, NoticeKind::contact, sentence); }

    void notify_of_contact()
    {
        if (sensor->is_reading())
            notify_once(notified_of_reading, NoticeKind::contact, reading_notice);
        if (sensor->exceeds_capacity())
            notify_once(notified_of_capacity, NoticeKind::contact, capacity_notice);
    }

    void notify_once(bool &notified, NoticeKind kind, std::string_view sentence)
    {
        const NoticeSink &sink = renderer.notice_sink();
        if (!std::exchange(notified, true) && sink)
            sink(Notice(kind, renderer.last_tick().time, sentence));
    }

    std::shared_ptr<ActiveRun> run; ///< for std::atomic_load() and its like
    Renderer renderer;
    std::unique_ptr<TouchSensor> sensor;
    std::uintptr_t tool = 0; ///< its body, kept in tool_watch
    BodyWatch tool_watch;
    CouplingProperties coupling;
    std::optional<Quaternion> grip; ///< the body's orientation in the handle's frame
    bool notified_of_light_tool = false;
    double tick_length = 0; ///< s
    int tool_jumps = 0;     ///< of RenderedTick
    bool notified_of_loss = false;
    bool notified_of_reading = false;
    bool notified_of_capacity = false;
    std::vector<Encounter> encounters;
};

HapticProbe::HapticProbe(Device &device, dSpaceID space, double radius, RenderSettings settings)
    : parts_(std::make_unique<Parts>(device, std::move(settings)))
{
    parts_->sensor = std::make_unique<TouchSensor>(space, radius);
}

HapticProbe::HapticProbe(Device &device, dGeomID geom, RenderSettings settings)
    : parts_(std::make_unique<Parts>(device, std::move(settings)))
{
    parts_->sensor = std::make_unique<TouchSensor>(geom);
}

HapticProbe::HapticProbe(Device &device, dBodyID tool, const CouplingProperties &coupling, RenderSettings settings)
    : parts_(std::make_unique<Parts>(device, std::move(settings)))
{
    parts_->tool = reinterpret_cast<std::uintptr_t>(tool);
    parts_->coupling = coupling;
    parts_->renderer.check(parts_->coupling);
    if (tool == nullptr)
        throw std::invalid_argument("The virtual coupling needs a tool body");
    parts_->tool_watch.keep(tool);
}

HapticProbe::~HapticProbe()
{
    if (const std::shared_ptr<ActiveRun> run = std::atomic_load(&parts_->run))
        run->end_and_wait("a haptic probe");
    try
    {
        parts_->notify_if_gone();
    }
    catch (...)
    {
        // a destructor must not throw
    }
}

void HapticProbe::take(std::shared_ptr<ActiveRun> run)
{
    std::shared_ptr<ActiveRun> none;
    if (!std::atomic_compare_exchange_strong(&parts_->run, &none, std::move(run)))
        throw std::logic_error("Another haptic loop uses the probe");
}

void HapticProbe::give_back() noexcept
{
    std::atomic_store(&parts_->run, {});
}

bool HapticProbe::is_taken() const
{
    return std::atomic_load(&parts_->run) != nullptr;
}

void HapticProbe::begin(double time, double clock_time)
{
    Renderer &renderer = parts_->renderer;
    renderer.read(time, clock_time);
    parts_->notify_if_gone();
    if (TouchSensor *sensor = parts_->sensor.get())
    {
        sensor->set_view(renderer.law().view());
        sensor->set_stiffness(renderer.rendered(renderer.law().material()).stiffness);
        sensor->clear();
        place(renderer.last_tick());
    }
}

void HapticProbe::place(const RenderedTick &tick)
{
    TouchSensor &sensor = *parts_->sensor;
    if (tick.tool_jumps != parts_->tool_jumps)
    {
        parts_->tool_jumps = tick.tool_jumps;
        sensor.forget_sides();
    }
    sensor.set_tick_length(parts_->tick_length);
    sensor.pose(tick.tool);
}

void HapticProbe::set_materials(MaterialOf materials)
{
    if (parts_->sensor)
        parts_->sensor->set_materials(std::move(materials));
}

bool HapticProbe::touch(dGeomID first, dGeomID second)
{
    return parts_->sensor && parts_->sensor->touch(first, second);
}

void HapticProbe::render(double dt)
{
    Renderer &renderer = parts_->renderer;
    parts_->tick_length = dt;
    renderer.note_fresh_physics();
    if (TouchSensor *sensor = parts_->sensor.get())
    {
        renderer.render(sensor->touches(), !sensor->saw_nonsense(), dt);
        sensor->push(renderer.shares());
        parts_->notify_of_contact();
    }
    else
    {
        parts_->render_tool_body(dt);
    }
}

const std::vector<Encounter> &HapticProbe::encounters()
{
    std::vector<Encounter> &encounters = parts_->encounters;
    encounters.clear();
    const dSpaceID space = geom() != nullptr ? dGeomGetSpace(geom()) : nullptr;
    if (space == nullptr || dSpaceIsPredictive(space) == 0)
        return encounters;
    const int most = dSpaceGetNumGeoms(space); // hundreds may be near at once
    std::vector<dPredictiveEncounter> found(static_cast<std::size_t>(most));
    const int count = dPredictiveSpaceGetEncounters(space, geom(), found.data(), most);
    encounters.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        encounters.push_back({found[i].geom, static_cast<double>(found[i].ticks) * parts_->tick_length});
    return encounters;
}

void HapticProbe::set_tick_length(double seconds)
{
    parts_->tick_length = seconds;
}

const RenderedTick &HapticProbe::last_tick() const
{
    return parts_->renderer.last_tick();
}

const std::vector<Touch> &HapticProbe::touches() const
{
    static const std::vector<Touch> none;
    return parts_->sensor ? parts_->sensor->touches() : none;
}

const ToolState &HapticProbe::tool() const
{
    return parts_->renderer.tool();
}

dGeomID HapticProbe::geom() const
{
    return parts_->sensor ? parts_->sensor->geom() : nullptr;
}

void HapticProbe::set_recorder(std::function<void(const RenderedTick &)> recorder)
{
    parts_->renderer.set_recorder(std::move(recorder));
}

Renderer &HapticProbe::renderer()
{
    return parts_->renderer;
}

TouchSensor *HapticProbe::sensor()
{
    return parts_->sensor.get();
}

dBodyID HapticProbe::tool_body() const
{
    return parts_->tool_watch.find(parts_->tool);
}
} // namespace ode_predictive_space::haptics
