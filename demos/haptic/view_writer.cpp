#include "demos/haptic/view_writer.h"

#include "demos/worlds/vector.h"

#include <algorithm>

namespace ode_predictive_space::demo
{
namespace
{
constexpr std::size_t geoms_per_step = 200; // read in a step: some 20 µs
constexpr double frame_seconds = 1. / 60;   // of the window
constexpr int steps_per_sample = 5;         // of the probe's path
constexpr double path_seconds = 0.15;       // how far into the future the path is drawn
constexpr int path_balls = 7;

window::NearPair line_between(dGeomID first, dGeomID second, bool with_probe)
{
    window::NearPair line;
    std::copy_n(dGeomGetPosition(first), 3, line.ends.begin());
    std::copy_n(dGeomGetPosition(second), 3, line.ends.begin() + 3);
    line.with_probe = with_probe;
    return line;
}

/// A wall can be near although its centre is far away.
bool is_wall(dGeomID geom, const Eigen::AlignedBox3d &room)
{
    return dGeomGetClass(geom) == dPlaneClass || !room.contains(worlds::from_ode(dGeomGetPosition(geom)));
}
} // namespace

ViewWriter::ViewWriter(const HapticRun &run, haptics::Snapshot<window::SceneView> &views, double picture_time)
    : run_(run), views_(views), picture_time_(picture_time), reader_(run.scene().world(), run.scene().room())
{}

void ViewWriter::after_step()
{
    if (++steps_ % steps_per_sample == 0)
        history_.add(steps_, run_.rendered().tool.position);
    if (holding_.load(std::memory_order_acquire))
        return;
    window::SceneView &view = views_.draft();
    const bool for_picture = run_.scene().time() >= picture_time_;
    const bool complete =
        reader_.read(for_picture ? std::numeric_limits<std::size_t>::max() : geoms_per_step, view.geoms);
    const auto now = std::chrono::steady_clock::now();
    if (!for_picture && (!complete || std::chrono::duration<double>(now - last_published_).count() < frame_seconds))
        return;
    finish(view);
    views_.publish();
    last_published_ = now;
    if (for_picture)
    {
        picture_time_ = std::numeric_limits<double>::infinity();
        holding_.store(true, std::memory_order_release);
    }
}

void ViewWriter::finish(window::SceneView &view) const
{
    view.time = run_.scene().time();
    view.low = run_.scene().room().min();
    view.high = run_.scene().room().max();
    write_near_pairs(view.near_pairs);
    window::ProbeView &probe = view.probe;
    probe.position = run_.rendered().tool.position;
    probe.radius = HapticRun::probe_radius;
    probe.force = run_.rendered().force;
    probe.max_force = run_.max_force();
    probe.touched.clear();
    for (const dGeomID geom : run_.touched())
        probe.touched.push_back(id_of(geom));
    probe.meetings.clear();
    for (const haptics::Encounter &meeting : run_.meetings())
        probe.meetings.push_back({id_of(meeting.geom), meeting.seconds});
    write_path(probe);
}

/// The path that the space fits to the last places of an interactive geom. The space's own is not public; the growth of the
/// balls stands for the deviation.
void ViewWriter::write_path(window::ProbeView &probe) const
{
    probe.path.clear();
    if (history_.count() == 0)
        return;
    const FittedPath fitted = history_.fit();
    const double ticks = path_seconds * 1e3;
    for (int i = 1; i <= path_balls; ++i)
    {
        const double tick = ticks * i / path_balls;
        const double deviation = fitted.residual * (1 + 0.02 * tick);
        probe.path.push_back({fitted.path.at(tick), probe.radius + deviation});
    }
}

void ViewWriter::write_near_pairs(std::vector<window::NearPair> &pairs) const
{
    pairs.clear();
    for (const auto &[first, second] : run_.scene().pairs().geoms())
    {
        if (!is_wall(first, run_.scene().room()) && !is_wall(second, run_.scene().room()))
            pairs.push_back(line_between(first, second, false));
    }
    for (const dGeomID geom : run_.scene().near_probe())
    {
        if (!is_wall(geom, run_.scene().room()))
            pairs.push_back(line_between(run_.probe_geom(), geom, true));
    }
}
} // namespace ode_predictive_space::demo
