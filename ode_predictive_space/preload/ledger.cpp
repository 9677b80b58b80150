#include "ode_predictive_space/preload/ledger.h"

#include <algorithm>

#include "ode_predictive_space/preload/settings.h"
#include "ode_predictive_space/recording/formatted.h"

namespace ode_predictive_space::preload
{
using recording::formatted;

namespace
{
// A program may make any number of spaces: from this one on, all share one line.
constexpr int last_space_with_line = 1000;

std::string times_text(const char *function, const CallTimes &times)
{
    if (times.calls == 0)
        return "";
    return formatted("; %s %lu calls, %.3f ms (mean %.3f us, largest %.3f us), callbacks %.3f ms", function,
                     times.calls, 1e3 * times.total, 1e6 * times.total / static_cast<double>(times.calls),
                     1e6 * times.largest, 1e3 * times.in_callbacks);
}

std::string space_line(const SpaceCounts &counts)
{
    const char *served = !counts.predictive                               ? "ODE's own"
                         : counts.proximity == dPredictiveProximitySphere ? "predictive by spheres"
                         : counts.proximity == dPredictiveProximityShape  ? "predictive by shapes"
                                                                          : "predictive by boxes";
    return formatted("  space %d%s: %s, %s; at most %d geoms, %lu pairs", counts.number,
                     counts.number >= last_space_with_line ? " and later ones" : "",
                     name_of_space_class(counts.space_class), served, counts.most_geoms, counts.reported) +
           times_text("dSpaceCollide", counts.collide) + times_text("dSpaceCollide2", counts.collide2) + "\n";
}

std::string counters_line(const dPredictiveSpaceStats &stats)
{
    if (stats.ticks == 0)
        return "";
    return formatted("    ticks %lu, moved %lu, violations %lu, repredictions %lu, scheduled %lu, "
                     "woken %lu, near_pairs %lu, scans %lu, bytes %lu\n",
                     stats.ticks, stats.moved, stats.violations, stats.repredictions, stats.scheduled, stats.woken,
                     stats.near_pairs, stats.scans, stats.bytes);
}
} // namespace

void CallTimes::add(double seconds, double callback_seconds)
{
    ++calls;
    total += seconds;
    largest = std::max(largest, seconds);
    in_callbacks += callback_seconds;
}

void Ledger::made(dSpaceID space, bool is_substitute)
{
    const std::lock_guard<std::mutex> guard(mutex_);
    enter(space, is_substitute);
}

bool Ledger::is_substitute(dSpaceID space) const
{
    const std::lock_guard<std::mutex> guard(mutex_);
    const auto found = current_.find(space);
    return found != current_.end() && found->second.is_substitute;
}

int Ledger::number_of(dSpaceID space)
{
    const std::lock_guard<std::mutex> guard(mutex_);
    return known(space).number;
}

Ledger::KnownSpace &Ledger::known(dSpaceID space)
{
    const auto found = current_.find(space);
    if (found == current_.end())
        return enter(space, false);
    if (!found->second.counts)
        found->second.counts = begin_counts(space, found->second.number);
    return found->second;
}

Ledger::KnownSpace &Ledger::enter(dSpaceID space, bool is_substitute)
{
    ++made_;
    return current_[space] = {made_, is_substitute, begin_counts(space, made_)};
}

SpaceCounts *Ledger::begin_counts(dSpaceID space, int number)
{
    if (number > last_space_with_line && !counts_.empty() && counts_.back().number >= last_space_with_line)
        return &counts_.back();
    return &counts_.emplace_back(SpaceCounts{number, dSpaceGetClass(space), dSpaceIsPredictive(space) != 0});
}

void Ledger::begin_in_child()
{
    counts_.clear();
    for (auto &each : current_)
        each.second.counts = nullptr;
    mutex_.unlock();
}

std::string Ledger::statistics() const
{
    const std::lock_guard<std::mutex> guard(mutex_);
    std::string text;
    for (const SpaceCounts &counts : counts_)
        text += space_line(counts) + counters_line(counts.stats);
    return text;
}
} // namespace ode_predictive_space::preload
