#include "ode_predictive_space/haptics/probe.h"

#include "ode_predictive_space/haptics/active_run.h"
#include "ode_predictive_space/haptics/with_lock.h"

#include <algorithm>
#include <ode/collision_space.h>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ode_predictive_space::haptics
{
HapticProbe::HapticProbe(Device &device, dSpaceID space, double radius, RenderSettings settings)
    : renderer_(device, std::move(settings)), sensor_(std::make_unique<TouchSensor>(space, radius))
{}

HapticProbe::HapticProbe(Device &device, dGeomID geom, RenderSettings settings)
    : renderer_(device, std::move(settings)), sensor_(std::make_unique<TouchSensor>(geom))
{}

HapticProbe::HapticProbe(Device &device, dBodyID tool, const CouplingProperties &coupling, RenderSettings settings)
    : renderer_(device, std::move(settings)), tool_body_(tool), coupling_(coupling)
{
    renderer_.check(coupling_);
    if (tool == nullptr)
    {
        throw std::invalid_argument("The virtual coupling needs a body to hold");
    }
    tool_watch_.keep(tool);
}

HapticProbe::~HapticProbe()
{
    std::shared_ptr<ActiveRun> run;
    {
        const std::lock_guard<std::mutex> lock(run_mutex_);
        run = run_;
    }
    if (run)
    {
        run->end_and_wait("a haptic probe");
    }
    try
    {
        tell_if_gone();
    }
    catch (...)
    {
        // a notice is not worth the program's end
    }
}

void HapticProbe::tell_if_gone()
{
    if (sensor_ && sensor_->is_gone() && !told_of_loss_)
    {
        told_of_loss_ = true;
        if (const NoticeSink &sink = renderer_.notice_sink())
        {
            sink(Notice(NoticeKind::contact, last_tick().time,
                        "No force: the probe's geom was destroyed with its space. The probe has to go first."));
        }
    }
}

void HapticProbe::take(std::shared_ptr<ActiveRun> run)
{
    with_lock(run_mutex_, [&] {
        if (run_)
        {
            throw std::logic_error("Another haptic loop runs the probe");
        }
        run_ = std::move(run);
    });
}

void HapticProbe::give_back() noexcept
{
    const std::lock_guard<std::mutex> lock(run_mutex_);
    run_.reset();
}

bool HapticProbe::is_taken() const
{
    const std::lock_guard<std::mutex> lock(run_mutex_);
    return run_ != nullptr;
}

void HapticProbe::begin(double time, double clock_time)
{
    renderer_.read(time, clock_time);
    tell_if_gone();
    if (sensor_)
    {
        sensor_->set_view(renderer_.law().view());
        sensor_->set_stiffness(renderer_.law().material().stiffness);
        sensor_->clear();
        place(renderer_.last_tick());
    }
}

void HapticProbe::place(const RenderedTick &tick)
{
    if (tick.tool_jumps != tool_jumps_)
    {
        tool_jumps_ = tick.tool_jumps;
        sensor_->forget_sides();
    }
    sensor_->set_tick_length(tick_length_);
    sensor_->pose(tick.tool);
}

void HapticProbe::set_materials(MaterialOf materials)
{
    if (sensor_)
    {
        sensor_->set_materials(std::move(materials));
    }
}

bool HapticProbe::touch(dGeomID first, dGeomID second)
{
    return sensor_ && sensor_->touch(first, second);
}

void HapticProbe::render(double dt)
{
    tick_length_ = dt;
    renderer_.note_fresh_physics();
    if (sensor_)
    {
        renderer_.render(sensor_->touches(), !sensor_->saw_nonsense(), dt);
        sensor_->push(renderer_.shares());
    }
    else
    {
        render_tool_body(dt);
    }
}

void HapticProbe::render_tool_body(double dt)
{
    if (tool_body_ != nullptr && !tool_watch_.has(tool_body_))
    {
        tool_body_ = nullptr;
        if (const NoticeSink &sink = renderer_.notice_sink())
        {
            sink(Notice(NoticeKind::contact, last_tick().time, "No force: the tool's body was destroyed."));
        }
    }
    if (tool_body_ == nullptr)
    {
        renderer_.render({}, true, dt);
        return;
    }
    add_wrench(tool_body_, renderer_.render(coupling_, tool_state_of(tool_body_), dt));
}

const std::vector<Encounter> &HapticProbe::encounters()
{
    encounters_.clear();
    const dSpaceID space = geom() != nullptr ? dGeomGetSpace(geom()) : nullptr;
    if (space == nullptr || dSpaceIsPredictive(space) == 0)
    {
        return encounters_;
    }
    const int most = dSpaceGetNumGeoms(space); // in a dense crowd, hundreds are near at once
    std::vector<dPredictiveEncounter> found(static_cast<std::size_t>(most));
    const int count = dPredictiveSpaceGetEncounters(space, sensor_->geom(), found.data(), most);
    encounters_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
    {
        encounters_.push_back({found[i].geom, static_cast<double>(found[i].ticks) * tick_length_});
    }
    return encounters_;
}

const std::vector<Touch> &HapticProbe::touches() const
{
    static const std::vector<Touch> none;
    return sensor_ ? sensor_->touches() : none;
}
} // namespace ode_predictive_space::haptics
