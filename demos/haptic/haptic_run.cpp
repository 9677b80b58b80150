#include "demos/haptic/haptic_run.h"

#include "demos/haptic/room.h"
#include "demos/runs/world_run.h"
#include "ode_predictive_space/haptics/recording.h"

namespace ode_predictive_space::demo
{
namespace
{
constexpr double usual_rate = 1000; // Hz

using worlds::Clock;
} // namespace

HapticRun::HapticRun(const Options &options, const worlds::WorldFactory &factory, DemoDevice &device,
                     RunControl &control, const haptics::NoticeSink &notice)
    : options_(options), device_(device), control_(control), scene_(options.spaces.front(), factory)
{
    const haptics::NoticeSink counted = [this, notice](const haptics::Notice &sent) {
        if (sent.kind == haptics::NoticeKind::guard || sent.kind == haptics::NoticeKind::watchdog)
            safety_notices_.fetch_add(1, std::memory_order_relaxed);
        notice(sent);
    };
    make_probe(counted);
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
    return options_.decoupled || options_.rate > 0 || scene_.step_seconds() > 1 / usual_rate;
}

/// Finds a free start with a margin in the room; otherwise without a margin, up to two radii beyond the room.
Vector3 HapticRun::free_start(const Vector3 &wish, const Eigen::AlignedBox3d &room) const
{
    constexpr double roomy = 1.5 * probe_radius;
    if (const auto place = worlds::free_place(scene(), wish, roomy, probe_radius, room))
        return *place;
    const Vector3 beyond = Vector3::Constant(2 * probe_radius);
    return worlds::free_place(scene(), wish, probe_radius, probe_radius / 4, {room.min() - beyond, room.max() + beyond})
        .value_or(wish);
}

/// The device's present position becomes a free start for the probe, and the whole room is within reach.
haptics::WorkspacePlacement HapticRun::place_hand()
{
    const Vector3 reach = (room().sizes() / 2 - Vector3::Constant(probe_radius)).cwiseMax(probe_radius);
    // The person looks along the scene's -x, as in the window: the device's x (right), y (up) and z (back) are its y, z and x.
    const haptics::Quaternion axes(0.5, 0.5, 0.5, 0.5);
    const Eigen::AlignedBox3d within_reach(room().center() - reach, room().center() + reach);
    const Eigen::AlignedBox3d workspace = device_.capabilities().workspace;
    haptics::WorkspacePlacement placement = haptics::WorkspacePlacement::covering(within_reach, workspace, axes);
    const Vector3 at_device = device_.read(0).position;
    const Vector3 wish = placement.offset + placement.scale * (axes * at_device);
    start_ = free_start(wish, within_reach);
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
    const std::string law = law_name(options_, device_);
    servo_log_.emplace(servo_rate(), options_.record_file, device_.capabilities(), law, !options_.replay_file.empty());
    haptics::RenderSettings settings;
    settings.placement = place_hand();
    settings.law = law_ =
        std::make_shared<AdjustableLaw>(law, options_, settings.placement.scale, device_.capabilities(), servo_rate());
    settings.rate = servo_rate();
    settings.physics_rate = 1 / scene_.step_seconds();
    settings.clutch_button = clutch_button;
    settings.notice = notice;
    probe_ = std::make_unique<haptics::HapticProbe>(device_, scene_.space(), probe_radius, settings);
    probe_->set_recorder([this](const haptics::RenderedTick &tick) { servo_log_->add(tick); });
    control_.stiffness = law_->at_hand(probe_->renderer().rendered(law_->material()).stiffness);
}

void HapticRun::make_loop(const haptics::NoticeSink &notice)
{
    haptics::LoopSettings settings;
    settings.rate = servo_rate();
    settings.decoupled = decoupled();
    settings.physics_rate = 1 / scene_.step_seconds();
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

void HapticRun::near_callback(void *run, dGeomID first, dGeomID second)
{
    auto &self = *static_cast<HapticRun *>(run);
    if (!self.contacts_.take(*self.probe_, first, second))
        worlds::PairList::collect(&self.scene_.pairs(), first, second);
}

void HapticRun::collide()
{
    scene_.pairs().clear();
    contacts_.clear();
    const Clock::time_point begin = Clock::now();
    dSpaceCollide(scene_.space(), this, &near_callback);
    step_log_.collided(worlds::seconds_between(begin, Clock::now()), pairs().size() + near_probe().size());
    law_->wish_stiffness(control_.stiffness.load(std::memory_order_relaxed));
    scene_.respond(control_.paused.load(std::memory_order_relaxed));
}

/// After the forces of this step have been rendered.
void HapticRun::advance()
{
    const Clock::time_point begin = Clock::now();
    contacts_.follow(time(), *probe_);
    scene_.advance(near_probe());
    const double seconds = worlds::seconds_between(begin, Clock::now());
    servo_log_->step_took(seconds);
    step_log_.advanced(seconds);
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
    result.collide = step_log_.collide();
    result.servo = servo_log_->totals();
    result.encounters = contacts_.log().summary();
    result.contacts = contacts_.log().contacts();
    result.series = {scene_.step_seconds(),      1 / servo_rate(),           step_log_.collide_series(),
                     step_log_.advance_series(), servo_log_->force_series(), servo_log_->period_series()};
    result.pairs = step_log_.pairs();
    result.stiffness = law_->at_hand(probe_->renderer().rendered(law_->material()).stiffness);
    result.scale = law_->scale();
    result.lost_in_recording = servo_log_->lost_in_recording();
    result.safety_notices = safety_notices_.load();
    if (dSpaceIsPredictive(scene_.space()) != 0)
        dPredictiveSpaceGetStats(scene_.space(), &result.space_stats.emplace());
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
