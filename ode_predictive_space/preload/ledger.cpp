#include "ode_predictive_space/preload/ledger.h"

#include <algorithm>
#include <cstdio>

#include "ode_predictive_space/preload/settings.h"

namespace ode_predictive_space::preload
{
namespace
{
template <typename... Arguments> std::string formatted(const char *format, Arguments... arguments)
{
    char text[512];
    std::snprintf(text, sizeof text, format, arguments...);
    return text;
}

std::string times_line(const char *function, const CallTimes &times)
{
    if (times.calls == 0)
        return "";
    const double mean = times.total / static_cast<double>(times.calls);
    return formatted("; %s %lu calls, %.3f ms (mean %.3f us, median %.3f us, largest %.3f us), callbacks %.3f ms",
                     function, times.calls, 1e3 * times.total, 1e6 * mean, 1e6 * times.median(), 1e6 * times.largest,
                     1e3 * times.in_callbacks);
}

std::string space_line(const SpaceRecord &record)
{
    const char *kind = name_of_space_class(record.space_class);
    const char *served = !record.predictive                               ? "ODE's own"
                         : record.proximity == dPredictiveProximitySphere ? "predictive by spheres"
                         : record.proximity == dPredictiveProximityShape  ? "predictive by shapes"
                                                                          : "predictive by boxes";
    return formatted("  space %d: %s, %s; at most %d geoms, %lu pairs", record.number, kind, served, record.most_geoms,
                     record.reported) +
           times_line("dSpaceCollide", record.collide) + times_line("dSpaceCollide2", record.collide2) + "\n";
}

std::string counters_line(const dPredictiveSpaceStats &stats)
{
    return formatted("    ticks %lu, moved %lu, verified %lu, violations %lu, re-predictions %lu, scheduled %lu, "
                     "woken %lu, near %lu, scans %lu, bytes %lu\n",
                     stats.ticks, stats.moved, stats.verified, stats.violations, stats.repredictions, stats.scheduled,
                     stats.woken, stats.near, stats.scans, stats.bytes);
}
} // namespace

void CallTimes::add(double seconds, double callback_seconds)
{
    ++calls;
    total += seconds;
    largest = std::max(largest, seconds);
    in_callbacks += callback_seconds;
    if (calls <= 1000000)
        first_calls.push_back(static_cast<float>(seconds));
}

double CallTimes::median() const
{
    std::vector<float> sorted = first_calls;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return sorted.empty() ? 0 : *middle;
}

void Ledger::made(dSpaceID space)
{
    const std::lock_guard<std::mutex> guard(mutex_);
    enter(space);
}

SpaceRecord &Ledger::record_of(dSpaceID space)
{
    const auto found = current_.find(space);
    return found != current_.end() ? *found->second : enter(space);
}

SpaceRecord &Ledger::enter(dSpaceID space)
{
    SpaceRecord record{};
    record.number = static_cast<int>(records_.size()) + 1;
    record.space_class = dSpaceGetClass(space);
    record.predictive = dSpaceIsPredictive(space) != 0;
    if (record.predictive)
        record.proximity = dPredictiveSpaceGetProximity(space);
    records_.push_back(record);
    current_[space] = &records_.back();
    return records_.back();
}

std::string Ledger::statistics()
{
    const std::lock_guard<std::mutex> guard(mutex_);
    std::string text;
    for (const SpaceRecord &record : records_)
    {
        text += space_line(record);
        if (record.stats.ticks > 0)
            text += counters_line(record.stats);
    }
    return text;
}

std::string Ledger::comparison()
{
    const std::lock_guard<std::mutex> guard(mutex_);
    unsigned long compared = 0, differences = 0;
    for (const SpaceRecord &record : records_)
    {
        compared += record.compared;
        differences += record.differences;
    }
    return formatted("  compared with all pairs: %lu collides, %lu differences\n", compared, differences);
}
} // namespace ode_predictive_space::preload
