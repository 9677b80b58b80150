#include "demos/haptic/haptic_run.h"

#include "demos/haptic/room.h"
#include "ode_predictive_space/haptics/penalty_law.h"
#include "ode_predictive_space/haptics/proxy_law.h"

#include <algorithm>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::demo
{
namespace
{
constexpr double usual_rate = 1000; // Hz

const haptics::Recording *recording_of(DemoDevice &device)
{
    const auto *replay = dynamic_cast<const haptics::ReplayDevice *>(&device.inner());
    return replay != nullptr ? &replay->recording() : nullptr;
}

/// The law of the options or, if they name none, that of the recording. Recordings that name no law were made when the penalty
/// law was the usual one.
std::shared_ptr<haptics::ForceLaw> make_law(const Options &options, const haptics::Recording *recording, double scale)
{
    const haptics::Material surface{options.stiffness / scale, options.damping / scale, options.friction};
    const std::string usual = recording != nullptr ? recording->law : "proxy";
    if ((options.law.empty() ? usual : options.law) == "proxy")
        return std::make_shared<haptics::ProxyLaw>(surface);
    return std::make_shared<haptics::PenaltyLaw>(surface);
}
} // namespace

HapticRun::HapticRun(const Options &options, const worlds::WorldFactory &factory, DemoDevice &device,
                     RunControl &control, const haptics::NoticeSink &notice)
    : options_(options), device_(device), control_(control), scene_(options.space, factory)
{
    result_.step_seconds = scene_.step_seconds();
    result_.servo_seconds = 1 / servo_rate();
    const haptics::NoticeSink counted = [this, notice](const haptics::Notice &sent) {
        if (sent.kind == haptics::NoticeKind::guard || sent.kind == haptics::NoticeKind::watchdog)
            safety_notices_.fetch_add(1, std::memory_order_relaxed);
        notice(sent);
    };
    make_probe(counted);
    make_adjustable();
    make_loop(counted);
}

HapticRun::~HapticRun()
{
    loop_.reset();
    probe_.reset();
    device_.close();
}

double HapticRun::servo_rate() const
{
    return options_.rate > 0 ? options_.rate : usual_rate;
}

bool HapticRun::decoupled() const
{
    return options_.decoupled || options_.rate > 0 || result_.step_seconds > 1 / usual_rate;
}

/// The device's present position becomes a free start for the probe, and the whole room is within reach.
haptics::WorkspacePlacement HapticRun::place_hand()
{
    const Eigen::AlignedBox3d &room = scene_.room();
    const Vector3 reach = (room.sizes() / 2 - Vector3::Constant(probe_radius)).cwiseMax(probe_radius);
    // The person looks along the scene's -x, as in the window: the device's x (right), y (up) and z (back) are its y, z and x.
    const haptics::Quaternion axes(0.5, 0.5, 0.5, 0.5);
    const Eigen::AlignedBox3d within_reach(room.center() - reach, room.center() + reach);
    const Eigen::AlignedBox3d workspace = device_.capabilities().workspace;
    haptics::WorkspacePlacement placement = haptics::WorkspacePlacement::covering(within_reach, workspace, axes);
    const Vector3 at_device = device_.read(0).position;
    const Vector3 wish = placement.offset + placement.scale * (axes * at_device);
    start_ = worlds::free_place(scene_.world(), wish, probe_radius, within_reach);
    if (start_ != wish)
    {
        const Vector3 moved = (start_ - wish).cwiseAbs();
        placement = haptics::WorkspacePlacement::covering({within_reach.min() - moved, within_reach.max() + moved},
                                                          workspace, axes);
        placement.offset = start_ - placement.scale * (axes * at_device);
    }
    return placement;
}

void HapticRun::make_probe(const haptics::NoticeSink &notice)
{
    device_.open(); // its capabilities and workspace are known only then
    const haptics::Recording *recording = recording_of(device_);
    haptics::RenderSettings settings;
    settings.placement = place_hand();
    settings.law = make_law(options_, recording, settings.placement.scale);
    settings.rate = servo_rate();
    settings.physics_rate = 1 / result_.step_seconds;
    settings.clutch_button = clutch_button;
    settings.notice = notice;
    result_.law = settings.law->name();
    servo_log_.emplace(servo_rate(), options_.record_file, device_.capabilities(), result_.law, recording != nullptr);
    probe_ = std::make_unique<haptics::HapticProbe>(device_, scene_.space(), probe_radius, settings);
    probe_->set_recorder([this](const haptics::RenderedTick &tick) { servo_log_->add(tick); });
}

/// Forces in the scene and at the hand are equal, but the probe moves `scale` times as far as the hand, so the stiffness at the
/// hand is the scale times that in the scene.
void HapticRun::make_adjustable()
{
    constexpr double more_than_any_device = 1e12; // N/m
    const haptics::Renderer &renderer = probe_->renderer();
    const haptics::WorkspaceMapping &mapping = renderer.mapping();
    const haptics::Material surface = renderer.rendered(probe_->renderer().law().material());
    const double stiffest = renderer.rendered({more_than_any_device, surface.damping}).stiffness;
    max_stiffness_ = mapping.stiffness_at_device(stiffest);
    result_.scale = mapping.placement().scale;
    control_.stiffness = mapping.stiffness_at_device(surface.stiffness);
    probe_->set_materials([this, surface, stiffest](dGeomID) {
        const double wish = control_.stiffness.load(std::memory_order_relaxed) / result_.scale;
        return haptics::Material{std::min(wish, stiffest), surface.damping, surface.friction};
    });
}

void HapticRun::make_loop(const haptics::NoticeSink &notice)
{
    haptics::LoopSettings settings;
    settings.rate = servo_rate();
    settings.decoupled = decoupled();
    settings.physics_rate = 1 / result_.step_seconds;
    if (options_.seconds > 0)
        settings.duration = options_.seconds;
    if (options_.fast)
    {
        settings.clock = &simulated_clock_;
        settings.ask_for_priority = false;
    }
    settings.notice = notice;
    loop_ = std::make_unique<haptics::HapticLoop>(*probe_, settings);
}

void HapticRun::follow_contacts()
{
    const auto is_touched = [&touches = probe_->touches()](dGeomID geom) {
        return std::any_of(touches.begin(), touches.end(), [geom](const haptics::Touch &touch) {
            return touch.depth > 0 && touch.object == haptics::object_of(geom);
        });
    };
    const std::vector<dGeomID> &near = scene_.near_probe();
    touched_.clear();
    std::copy_if(near.begin(), near.end(), std::back_inserter(touched_), is_touched);
    meetings_ = probe_->encounters();
    encounter_log_.add(scene_.time(), meetings_, probe_->touches());
}

RunResult HapticRun::run(const std::function<void()> &after_step)
{
    haptics::SceneWork work;
    work.collide = [this] { scene_.collide(*probe_, control_.paused.load(std::memory_order_relaxed)); };
    work.advance = [this, &after_step](double) { // the forces of this step have been rendered
        follow_contacts();
        servo_log_->step_took(scene_.advance());
        if (after_step)
            after_step();
    };
    result_.loop = loop_->run(work);
    servo_log_->close();
    result_.scene = scene_.totals();
    result_.servo = servo_log_->totals();
    result_.contacts = encounter_log_.contacts();
    result_.stiffness = control_.stiffness;
    result_.lost_in_recording = servo_log_->lost_in_recording();
    result_.safety_notices = safety_notices_.load();
    if (dSpaceIsPredictive(scene_.space()) != 0)
        result_.encounters = encounter_log_.summary();
    compare_with_recording();
    return result_;
}

void HapticRun::compare_with_recording()
{
    const haptics::Recording *recording = recording_of(device_);
    if (recording == nullptr || !recording->has_forces)
        return;
    std::vector<Vector3> rendered = servo_log_->forces(), recorded;
    result_.replayed_ticks = std::min(rendered.size(), recording->ticks.size());
    for (std::size_t i = 0; i < result_.replayed_ticks; ++i)
        recorded.push_back(recording->ticks[i].force);
    rendered.resize(recorded.size());
    if (!recorded.empty())
        result_.replay_error = haptics::compare_forces(recorded, rendered);
}
} // namespace ode_predictive_space::demo
