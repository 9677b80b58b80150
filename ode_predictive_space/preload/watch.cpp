#include "ode_predictive_space/preload/watch.h"

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <optional>
#include <utility>

#include <cerrno>
#include <unistd.h>

#include <ode/collision.h>

#include "ode_predictive_space/preload/comparison.h"
#include "ode_predictive_space/preload/notes_to_launcher.h"
#include "ode_predictive_space/preload/report.h"
#include "ode_predictive_space/preload/say.h"

namespace ode_predictive_space::preload
{
namespace
{
double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_time()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The ticks of a thread: a tick ends with a collide that no callback of another one has asked for. Recording is no part of it.
class TickClock
{
public:
    /// A collide is about to be recorded.
    void begin_recording()
    {
        paused_ = processor_time();
        ++depth_;
    }

    /// It begins, or after it: it has been recorded.
    void end_recording() { recording_ += processor_time() - paused_; }

    void pause() { paused_ = processor_time(); }

    /// Between pause() and end_recording(), of the collide that ends.
    ///
    /// @return the seconds of the tick; 0: it is the first one. Negative: the tick goes on.
    double end_collide()
    {
        if (--depth_ > 0)
            return -1;
        const double before = std::exchange(since_, paused_ - recording_);
        return before < 0 ? 0 : std::max(0.0, since_ - before);
    }

private:
    double since_ = -1;    // end of the tick before, in processor time without recording
    double recording_ = 0; // of all recording
    double paused_ = 0;
    int depth_ = 0;
};

thread_local TickClock tick_clock;

// What one reading of the clock takes; the least of many, for the machine may do other things in between.
double cost_of_clock()
{
    static const double cost = [] {
        double least = 1;
        for (int i = 0; i < 100; ++i)
        {
            const double start = now();
            for (int reading = 0; reading < 10; ++reading)
                now();
            least = std::min(least, (now() - start) / 11);
        }
        return least;
    }();
    return cost;
}

std::string described(dGeomID geom)
{
    static const char *const names[] = {"sphere", "box",    "capsule",   "cylinder", "plane",
                                        "ray",    "convex", "transform", "trimesh",  "heightfield"};
    const int geom_class = dGeomGetClass(geom);
    const char *name = dGeomIsSpace(geom)                ? "space"
                       : geom_class <= dHeightfieldClass ? names[geom_class]
                                                         : "user's geom";
    dReal b[6];
    dGeomGetAABB(geom, b);
    char text[256];
    std::snprintf(text, sizeof text, "%s %p [%g %g] x [%g %g] x [%g %g]", name, static_cast<void *>(geom), b[0], b[1],
                  b[2], b[3], b[4], b[5]);
    return text;
}
// A file of this name; with the number of this process when there is such a file already. There may be one with its number, too, of
// another process or of the program that this process was before.
recording::HistoryFile new_file(const std::string &name, std::string &path)
{
    const std::string numbered = name + "." + std::to_string(getpid());
    path = name;
    for (int others = 1;; ++others)
    {
        recording::HistoryFile file(path, true);
        if (file.error() != EEXIST && file.error() != EBUSY)
            return file;
        path = others == 1 ? numbered : numbered + "." + std::to_string(others);
    }
}
} // namespace

// One call of dSpaceCollide() or dSpaceCollide2() on its way through the watch.
struct Watch::Call
{
    dSpaceID space;
    const char *function;
    std::function<void(void *, dNearCallback *)> native;
    std::function<std::vector<Pair>()> expected;
    std::function<recording::Recorder::Event(recording::Recorder &)> recorded;
    CallTimes SpaceCounts::*times;

    void *data = nullptr;
    dNearCallback *callback = nullptr;
    unsigned long reported = 0;
    double in_callbacks = 0;
    double seconds = 0;
    std::optional<Comparison> comparison = {};
    std::optional<recording::Recorder::Event> event = {};
    bool keep = false; // the pairs, for later, instead of calling back at once
    std::vector<Pair> kept = {};
};

Watch::Watch(const Settings &settings, const OdeCalls &calls) : settings_(settings), ode_(calls)
{
    cost_of_clock();
    records_ = !settings.record_file.empty();
    if (!settings.trace_file.empty())
        trace_file_ = std::make_unique<OutputFile>(settings.trace_file);
}

// ODE itself refuses bad arguments, as it does without the watch.
void Watch::collide(dSpaceID space, void *data, dNearCallback *callback)
{
    if (!space || !callback)
        return ode_.collide(space, data, callback);
    Call call{space,
              "dSpaceCollide",
              [=](void *d, dNearCallback *c) { ode_.collide(space, d, c); },
              [=] { return expected_pairs(space); },
              [=](recording::Recorder &recorder) { return recorder.begin_collide(space); },
              &SpaceCounts::collide};
    run(call, data, callback);
}

void Watch::collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback)
{
    const dSpaceID space = first && second && callback ? asked_space(first, second) : nullptr;
    if (!space)
        return ode_.collide2(first, second, data, callback);
    Call call{space,
              "dSpaceCollide2",
              [=](void *d, dNearCallback *c) { ode_.collide2(first, second, d, c); },
              [=] { return expected_pairs(first, second); },
              [=](recording::Recorder &recorder) { return recorder.begin_collide2(first, second); },
              &SpaceCounts::collide2};
    run(call, data, callback);
}

void Watch::run(Call &call, void *data, dNearCallback *callback)
{
    call.data = data;
    call.callback = callback;
    call.keep = trace_file_ != nullptr;
    const bool predictive = dSpaceIsPredictive(call.space) != 0;
    const int proximity = predictive ? dPredictiveSpaceGetProximity(call.space) : dPredictiveProximityBox;
    if (settings_.compare && (predictive || settings_.replaced.empty()))
        call.comparison.emplace(call.expected(), proximity != dPredictiveProximityBox);
    if (call.keep)
        call.kept.reserve(1000);

    if (recording::Recorder *const recorder = this->recorder())
    {
        tick_clock.begin_recording();
        call.event.emplace(call.recorded(*recorder));
        tick_clock.end_recording();
    }

    const double start = now();
    call.native(&call, &Watch::on_pair);
    const double inside = now() - start - call.in_callbacks;
    // A callback that is measured adds one of its two readings of the clock to the space's time.
    const double readings = 1 + (call.keep ? 0 : static_cast<double>(call.reported));
    call.seconds = std::max(0.0, inside - readings * cost_of_clock());

    if (call.event)
        end_event(call);
    if (call.comparison)
        judge(call);
    if (call.keep)
        trace(call);
    ledger_.with(call.space, [&](KnownSpace &known) {
        SpaceCounts &counts = *known.counts;
        counts.proximity = proximity;
        counts.most_geoms = std::max(counts.most_geoms, dSpaceGetNumGeoms(call.space));
        counts.reported += call.reported;
        (counts.*call.times).add(call.seconds, call.in_callbacks);
        if (!predictive)
            return;
        dPredictiveSpaceGetStats(call.space, &known.latest);
        counts.stats = since(known.before_fork, known.latest);
    });
}

void Watch::end_event(Call &call)
{
    tick_clock.pause();
    const double tick = tick_clock.end_collide();
    const recording::EventTimes times = {static_cast<float>(call.seconds), static_cast<float>(call.in_callbacks),
                                         static_cast<float>(tick)};
    call.event->end(tick < 0 ? nullptr : &times);
    tick_clock.end_recording();
}

void Watch::on_pair(void *data, dGeomID first, dGeomID second)
{
    Call &call = *static_cast<Call *>(data);
    ++call.reported;
    if (call.comparison)
        call.comparison->note(first, second);
    const double start = call.keep ? 0 : now(); // recording is not the space's time
    if (call.event)
        call.event->note(first, second);
    if (call.keep)
    {
        call.kept.emplace_back(first, second);
        return;
    }
    call.callback(call.data, first, second);
    call.in_callbacks += now() - start;
}

// The file is made at the first collide. Of several processes the first one to get there has it; each other one adds its number.
recording::Recorder *Watch::recorder()
{
    if (!records_)
        return nullptr;
    const std::lock_guard<std::mutex> guard(recording_);
    if (recorder_)
        return recorder_.get();
    recording::HistoryFile file = new_file(settings_.record_file, recorded_file_);
    if (!file.is_open())
    {
        say("%s cannot be written: %s; nothing is recorded", recorded_file_.c_str(), std::strerror(file.error()));
        leave_note(Note::lost);
        records_ = false;
        return nullptr;
    }
    recorder_ =
        std::make_unique<recording::Recorder>(std::move(file), settings_.record_limit, recording::note_of_process(),
                                              [this](dSpaceID space) { return ledger_.is_substitute(space); });
    return recorder_.get();
}

void Watch::begin_recording_in_child()
{
    if (recorder_)
        recorder_->leave_to_parent();
    // The recorder may be in the middle of something, in another thread that this process does not have: it is not touched again.
    static_cast<void>(recorder_.release());
    recording_.unlock();
}

void Watch::end_recording()
{
    const std::lock_guard<std::mutex> guard(recording_);
    if (!recorder_ || recorder_->close())
        return;
    say("%s could not be written to its end", recorded_file_.c_str());
    leave_note(Note::lost);
}

void Watch::judge(Call &call)
{
    constexpr unsigned long most_complaints = 10;
    const std::vector<Difference> differences = call.comparison->finish();
    ledger_.with(call.space, [&](KnownSpace &known) {
        SpaceCounts &counts = *known.counts;
        ++counts.compared;
        counts.differences += differences.size();
        for (const Difference &difference : differences)
        {
            if (complaints_++ < most_complaints)
                say("space %d, %s() number %lu: %s: %s and %s", known.number, call.function,
                    (counts.*call.times).calls + 1, difference.what, described(difference.pair.first).c_str(),
                    described(difference.pair.second).c_str());
            else if (complaints_ == most_complaints + 1)
                say("more differences follow; they are only counted");
        }
    });
}

// The callbacks come after the collide, in an order that does not depend on the space: where nothing else does, the program
// then goes the same way with every space that reports the same pairs.
void Watch::trace(Call &call)
{
    const std::uint64_t hash = put_in_order(call.kept);
    const int number = ledger_.with(call.space, [](const KnownSpace &known) { return known.number; });
    char line[160];
    std::snprintf(line, sizeof line, "%s space %d geoms %d pairs %zu hash %016" PRIx64 "\n", call.function, number,
                  dSpaceGetNumGeoms(call.space), call.kept.size(), hash);
    if (!trace_file_->write(line))
        leave_note(Note::lost);
    const double start = now();
    for (const Pair &pair : call.kept)
        call.callback(call.data, pair.first, pair.second);
    call.in_callbacks = now() - start;
}

void Watch::report()
{
    end_recording();
    const std::deque<SpaceCounts> spaces = ledger_.all();
    if (!write_report(settings_, report_text(settings_, program_invocation_short_name, getpid(), spaces)))
        leave_note(Note::lost);
    if (!spaces.empty())
        leave_note(Note::finished);
}
} // namespace ode_predictive_space::preload
