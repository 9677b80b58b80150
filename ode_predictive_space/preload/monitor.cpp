#include "ode_predictive_space/preload/monitor.h"

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

#include <cerrno>
#include <unistd.h>

#include <ode/collision.h>

#include "ode_predictive_space/preload/pairs.h"
#include "ode_predictive_space/preload/say.h"
#include "ode_predictive_space/recording/formatted.h"

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

// Measures the ticks of a thread, without the time for recording. A tick ends with an outermost collide, which is not called by
// a callback of another one.
class TickClock
{
public:
    /// Must be called before the begin of a collide is recorded.
    void begin_recording()
    {
        paused_ = processor_time();
        ++depth_;
    }

    /// Must be called when the begin or the end of a collide has been recorded.
    void end_recording() { recording_ += processor_time() - paused_; }

    void pause() { paused_ = processor_time(); }

    /// Must be called at the end of a collide, between pause() and end_recording().
    /// @return the seconds of the tick that ends; 0 for the first one; negative if the tick continues.
    double end_collide()
    {
        if (--depth_ > 0)
            return -1;
        const double before = std::exchange(since_, paused_ - recording_);
        return before < 0 ? 0 : std::max(0.0, since_ - before);
    }

private:
    double since_ = -1;    // end of the last tick, in processor time without recording
    double recording_ = 0; // time of all recording
    double paused_ = 0;
    int depth_ = 0;
};

thread_local TickClock tick_clock;

// Seconds for one reading of the clock: the least of many measurements, because the machine may be interrupted.
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

// Makes a file of this name. When it exists already, the number of this process is appended, and a further number when that
// file exists, too: another process or an earlier program in this process may have made it.
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

struct Monitor::Call
{
    dSpaceID space;
    const char *function;
    CallTimes SpaceCounts::*times;
    void *data;
    dNearCallback *callback;

    unsigned long reported = 0;
    double in_callbacks = 0;
    double seconds = 0; // in the space
    std::optional<recording::Recorder::Event> event = {};
    bool keep = false; // the pairs, and call back after the collide
    std::vector<Pair> kept = {};
};

Monitor::Monitor(const Settings &settings, const OdeCalls &calls) : settings_(settings), ode_(calls)
{
    cost_of_clock();
    records_ = !settings.record_file.empty();
    if (!settings.trace_file.empty())
        trace_file_ = std::make_unique<OutputFile>(settings.trace_file);
}

// Bad arguments are left to ODE, which refuses them.
void Monitor::collide(dSpaceID space, void *data, dNearCallback *callback)
{
    if (!space || !callback)
        return ode_.collide(space, data, callback);
    Call call{space, "dSpaceCollide", &SpaceCounts::collide, data, callback};
    run(
        call, [&] { ode_.collide(space, &call, &Monitor::on_pair); },
        [&](recording::Recorder &recorder) { return recorder.begin_collide(space); });
}

void Monitor::collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback)
{
    const dSpaceID space = first && second && callback ? asked_space(first, second) : nullptr;
    if (!space)
        return ode_.collide2(first, second, data, callback);
    Call call{space, "dSpaceCollide2", &SpaceCounts::collide2, data, callback};
    run(
        call, [&] { ode_.collide2(first, second, &call, &Monitor::on_pair); },
        [&](recording::Recorder &recorder) { return recorder.begin_collide2(first, second); });
}

template <typename Native, typename Record> void Monitor::run(Call &call, Native native, Record record)
{
    call.keep = trace_file_ != nullptr;
    if (call.keep)
        call.kept.reserve(1000);
    if (recording::Recorder *const recorder = this->recorder())
    {
        tick_clock.begin_recording();
        call.event.emplace(record(*recorder));
        tick_clock.end_recording();
    }

    const double start = now();
    native();
    const double inside = now() - start - call.in_callbacks;
    // For each callback that is measured, one of its two readings of the clock falls into the space's time.
    const double readings = 1 + (call.keep ? 0 : static_cast<double>(call.reported));
    call.seconds = std::max(0.0, inside - readings * cost_of_clock());

    if (call.event)
        end_event(call);
    if (call.keep)
        trace(call);
    count(call);
}

void Monitor::count(const Call &call)
{
    ledger_.with_counts(call.space, [&](SpaceCounts &counts) {
        counts.most_geoms = std::max(counts.most_geoms, dSpaceGetNumGeoms(call.space));
        counts.reported += call.reported;
        (counts.*call.times).add(call.seconds, call.in_callbacks);
        if (!dSpaceIsPredictive(call.space))
            return;
        counts.proximity = dPredictiveSpaceGetProximity(call.space);
        dPredictiveSpaceGetStats(call.space, &counts.stats);
    });
}

void Monitor::end_event(Call &call)
{
    tick_clock.pause();
    const double tick = tick_clock.end_collide();
    const recording::EventTimes times = {static_cast<float>(call.seconds), static_cast<float>(call.in_callbacks),
                                         static_cast<float>(tick)};
    call.event->end(tick < 0 ? nullptr : &times);
    tick_clock.end_recording();
}

void Monitor::on_pair(void *data, dGeomID first, dGeomID second)
{
    Call &call = *static_cast<Call *>(data);
    ++call.reported;
    const double start = call.keep ? 0 : now(); // before recording, which is not the space's time
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

// The file is made at the first collide of the process.
recording::Recorder *Monitor::recorder()
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
        records_ = false;
        return nullptr;
    }
    recorder_ =
        std::make_unique<recording::Recorder>(std::move(file), settings_.record_limit, recording::note_of_process(),
                                              [this](dSpaceID space) { return ledger_.is_substitute(space); });
    return recorder_.get();
}

void Monitor::begin_recording_in_child()
{
    if (recorder_)
        recorder_->leave_to_parent();
    // Another thread of the parent may have been writing to it, which leaves it inconsistent here: it is not destroyed.
    static_cast<void>(recorder_.release());
    recording_.unlock();
}

void Monitor::end_recording()
{
    const std::lock_guard<std::mutex> guard(recording_);
    if (recorder_ && !recorder_->close())
        say("%s could not be written to its end; what was written can be replayed", recorded_file_.c_str());
}

// Calls the callbacks after the collide, in an order that does not depend on the space. A deterministic program then does the
// same with all spaces that report the same pairs.
void Monitor::trace(Call &call)
{
    const std::uint64_t hash = put_in_order(call.kept);
    char line[160];
    std::snprintf(line, sizeof line, "%s space %d geoms %d pairs %zu hash %016" PRIx64 "\n", call.function,
                  ledger_.number_of(call.space), dSpaceGetNumGeoms(call.space), call.kept.size(), hash);
    trace_file_->write(line);
    const double start = now();
    for (const Pair &pair : call.kept)
        call.callback(call.data, pair.first, pair.second);
    call.in_callbacks = now() - start;
}

void Monitor::finish()
{
    end_recording();
    if (settings_.stats)
        write_statistics();
}

void Monitor::write_statistics() const
{
    std::string text = ledger_.statistics();
    if (text.empty())
        return;
    text = recording::formatted("ode_predictive_space: %s (process %d)\n",
                                printable(program_invocation_short_name).c_str(), getpid()) +
           text;
    if (!settings_.stats_file.empty() && OutputFile(settings_.stats_file).write(text))
        return;
    const NoSignalOfWriting quiet;
    std::fputs(text.c_str(), stderr);
}
} // namespace ode_predictive_space::preload
