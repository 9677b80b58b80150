#include "demos/haptic/haptic_run.h"

#include "demos/haptic/free_place.h"
#include "demos/haptic/room.h"
#include "demos/runs/world_run.h"
#include "ode_predictive_space/haptics/penalty_law.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/safety.h"

#include <algorithm>

namespace ode_predictive_space::demo
{
namespace
{
constexpr double usual_rate = 1000;           // Hz
constexpr double more_than_any_device = 1e12; // N/m

using worlds::Clock;
} // namespace

HapticRun::HapticRun(const Options &options, const worlds::WorldFactory &factory, DemoDevice &device,
                     RunControl &control, const haptics::NoticeSink &notice)
    : options_(options), device_(device), control_(control), tick_seconds_(factory.tick_seconds()),
      decoupled_(options.decoupled || options.rate > 0 || tick_seconds_ > 1 / usual_rate),
      servo_rate_(options.rate > 0 ? options.rate : usual_rate),
      space_(worlds::make_space(worlds::space_named(options.spaces.front()), factory)),
      scene_(factory.make(space_.get())), room_(worlds::room_inside_walls(*scene_, factory.bounds()))
{
    make_probe(counted(notice));
    make_loop(counted(notice));
}

haptics::NoticeSink HapticRun::counted(const haptics::NoticeSink &notice)
{
    return [this, notice](const haptics::Notice &told) {
        if (told.kind == haptics::NoticeKind::guard || told.kind == haptics::NoticeKind::watchdog)
            safety_notices_.fetch_add(1, std::memory_order_relaxed);
        notice(told);
    };
}

/// With some room around it; where the scene is too small for that, with none, and beyond the room if there is no wall.
Vector3 HapticRun::free_start(const Vector3 &wish, const Eigen::AlignedBox3d &room) const
{
    constexpr double roomy = 1.5 * probe_radius;
    if (const auto place = worlds::free_place(*scene_, wish, roomy, probe_radius, room))
        return *place;
    const Vector3 beyond = Vector3::Constant(2 * probe_radius);
    return worlds::free_place(*scene_, wish, probe_radius, probe_radius / 4, {room.min() - beyond, room.max() + beyond})
        .value_or(wish);
}

/// The device's position now is a place where the probe is in nothing; all of the room is within reach, and some more.
haptics::WorkspacePlacement HapticRun::placement()
{
    const Vector3 reach = (room_.sizes() / 2 - Vector3::Constant(probe_radius)).cwiseMax(probe_radius);
    // The person looks along the scene's -x, as the window does: x, to the right, is the scene's y; y, upwards, its z; and z,
    // towards the person, its x.
    const haptics::Quaternion axes(0.5, 0.5, 0.5, 0.5);
    const Eigen::AlignedBox3d room(room_.center() - reach, room_.center() + reach);
    const Eigen::AlignedBox3d workspace = device_.capabilities().workspace;
    haptics::WorkspacePlacement placement = haptics::WorkspacePlacement::covering(room, workspace, axes);
    const Vector3 at_device = device_.read(0).position;
    const Vector3 wish = placement.offset + placement.scale * (axes * at_device);
    start_ = free_start(wish, room);
    if (start_ != wish)
    {
        const Vector3 moved = (start_ - wish).cwiseAbs();
        placement = haptics::WorkspacePlacement::covering({room.min() - moved, room.max() + moved}, workspace, axes);
        placement.offset = start_ - placement.scale * (axes * at_device);
    }
    return placement;
}

// Recordings that name no law were made when the penalty law was the usual one.
std::string HapticRun::law_name() const
{
    const auto *replay = dynamic_cast<const haptics::ReplayDevice *>(&device_.inner());
    if (replay == nullptr || options_.law_given)
        return options_.law;
    const std::string &recorded = replay->recording().law;
    return recorded.empty() ? "penalty" : recorded;
}

// A newton in the scene is one at the hand, but the probe moves farther than the hand, by the scale of the workspace.
std::shared_ptr<AdjustableLaw> HapticRun::make_law() const
{
    const haptics::SurfaceProperties surface{options_.stiffness / scale_, options_.damping / scale_, options_.friction};
    if (law_name() == "proxy")
        return std::make_shared<AdjustableLaw>(std::make_unique<haptics::ProxyLaw>(surface));
    return std::make_shared<AdjustableLaw>(std::make_unique<haptics::PenaltyLaw>(surface));
}

double HapticRun::stiffest() const
{
    haptics::Rendering rendering;
    rendering.stiffness = more_than_any_device;
    rendering.damping = options_.damping;
    rendering.rate = servo_rate_;
    rendering.delay = device_.capabilities().delay;
    return haptics::check_stability(device_.capabilities(), rendering).stiffness;
}

void HapticRun::make_probe(const haptics::NoticeSink &notice)
{
    device_.open(); // its capabilities and workspace are known only then
    servo_log_.emplace(servo_rate_, options_.record_file, device_.capabilities(), law_name(),
                       !options_.replay_file.empty());
    haptics::RenderSettings settings;
    settings.placement = placement();
    scale_ = settings.placement.scale;
    settings.law = law_ = make_law();
    settings.rate = servo_rate_;
    settings.physics_rate = 1 / tick_seconds_;
    settings.clutch_button = clutch_button;
    settings.notice = notice;
    max_stiffness_ = stiffest();
    probe_ = std::make_unique<haptics::HapticProbe>(device_, space_.get(), probe_radius, settings);
    probe_->set_recorder([this](const haptics::RenderedTick &tick) { servo_log_->add(tick); });
    control_.stiffness = probe_->renderer().rendered(law_->material()).stiffness * scale_;
}

void HapticRun::make_loop(const haptics::NoticeSink &notice)
{
    haptics::LoopSettings settings;
    settings.rate = servo_rate_;
    settings.decoupled = decoupled_;
    settings.physics_rate = 1 / tick_seconds_;
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

HapticRun::~HapticRun()
{
    loop_.reset();
    probe_.reset();
    device_.close();
}

void HapticRun::near_callback(void *run, dGeomID first, dGeomID second)
{
    auto &self = *static_cast<HapticRun *>(run);
    if (self.probe_->touch(first, second))
    {
        self.near_.push_back(first == self.probe_geom() ? second : first);
        return;
    }
    worlds::PairList::collect(&self.pairs_, first, second);
}

void HapticRun::collide()
{
    pairs_.clear();
    near_.clear();
    const Clock::time_point begin = Clock::now();
    dSpaceCollide(space_.get(), this, &near_callback);
    const double seconds = worlds::seconds_between(begin, Clock::now());
    collide_times_.add(seconds);
    collide_series_.add(seconds);
    pair_count_ += pairs_.size() + near_.size();
    adjust_stiffness();
    stands_still_ = control_.paused.load(std::memory_order_relaxed);
    if (!stands_still_)
        scene_->respond(pairs_.sorted()); // a loop of two threads foresees motion by the contacts that there are
}

/// After the forces of this step have been rendered.
void HapticRun::advance()
{
    const Clock::time_point begin = Clock::now();
    find_touched();
    look_ahead();
    if (stands_still_)
        hold_still();
    else
        scene_->advance();
    ++steps_;
    time_ = static_cast<double>(steps_) * tick_seconds_;
    const double seconds = worlds::seconds_between(begin, Clock::now());
    servo_log_->step_took(seconds);
    advance_series_.add(seconds);
}

void HapticRun::find_touched()
{
    touched_.clear();
    for (const dGeomID geom : near_)
    {
        const auto &touches = probe_->touches();
        if (std::any_of(touches.begin(), touches.end(), [geom](const haptics::Touch &touch) {
                return touch.depth > 0 && touch.object == haptics::object_of(geom);
            }))
            touched_.push_back(geom);
    }
}

void HapticRun::look_ahead()
{
    meetings_ = probe_->encounters();
    encounter_log_.add(time_, meetings_, probe_->touches());
}

/// The reactions of this step have been added to the bodies' forces, which the next step of the world would use.
void HapticRun::hold_still()
{
    for (const dGeomID geom : near_)
    {
        if (const dBodyID body = dGeomGetBody(geom); body != nullptr)
        {
            dBodySetForce(body, 0, 0, 0);
            dBodySetTorque(body, 0, 0, 0);
        }
    }
}

void HapticRun::adjust_stiffness()
{
    law_->wish_stiffness(control_.stiffness.load(std::memory_order_relaxed) / scale_);
}

RunResult HapticRun::run(const std::function<void()> &after_step)
{
    haptics::SceneWork work;
    work.collide = [this] { collide(); };
    work.advance = [this, &after_step](double) {
        advance();
        if (after_step)
            after_step();
    };
    RunResult result;
    result.loop = loop_->run(work);
    servo_log_->close();
    result.collide = collide_times_.summary();
    result.servo = servo_log_->totals();
    result.encounters = encounter_log_.summary();
    result.contacts = encounter_log_.contacts();
    result.series = {tick_seconds_,
                     1 / servo_rate_,
                     collide_series_,
                     advance_series_,
                     servo_log_->force_series(),
                     servo_log_->period_series()};
    result.pairs = pair_count_;
    result.stiffness = probe_->renderer().rendered(law_->material()).stiffness * scale_;
    result.scale = scale_;
    result.lost_in_recording = servo_log_->lost_in_recording();
    result.safety_notices = safety_notices_.load();
    if (dSpaceIsPredictive(space_.get()) != 0)
        dPredictiveSpaceGetStats(space_.get(), &result.space_stats.emplace());
    compare_with_recording(result);
    return result;
}

void HapticRun::compare_with_recording(RunResult &result)
{
    const auto *replay = dynamic_cast<const haptics::ReplayDevice *>(&device_.inner());
    if (replay == nullptr || !replay->recording().has_forces)
        return;
    std::vector<Vector3> recorded;
    for (const haptics::RecordedTick &tick : replay->recording().ticks)
        recorded.push_back(tick.force);
    std::vector<Vector3> rendered = servo_log_->forces();
    const std::size_t common = std::min(recorded.size(), rendered.size());
    recorded.resize(common);
    rendered.resize(common);
    if (common > 0)
    {
        result.replay_error = haptics::compare_forces(recorded, rendered);
        result.replayed_ticks = common;
    }
}
} // namespace ode_predictive_space::demo
