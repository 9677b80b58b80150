#include "ode_predictive_space/preload/report.h"

#include <cstdio>

#include "ode_predictive_space/preload/output_file.h"
#include "ode_predictive_space/recording/formatted.h"
#include "ode_predictive_space/recording/printable.h"

namespace ode_predictive_space::preload
{
using recording::formatted;

namespace
{
std::string times_line(const char *function, const CallTimes &times)
{
    if (times.calls == 0)
        return "";
    const double mean = times.total / static_cast<double>(times.calls);
    return formatted("; %s %lu calls, %.3f ms (mean %.3f us, median %.3f us, largest %.3f us), callbacks %.3f ms",
                     function, times.calls, 1e3 * times.total, 1e6 * mean, 1e6 * times.durations.median(),
                     1e6 * times.largest, 1e3 * times.in_callbacks);
}

std::string space_line(const SpaceCounts &counts)
{
    const char *kind = name_of_space_class(counts.space_class);
    const char *served = !counts.predictive                               ? "ODE's own"
                         : counts.proximity == dPredictiveProximitySphere ? "predictive by spheres"
                         : counts.proximity == dPredictiveProximityShape  ? "predictive by shapes"
                                                                          : "predictive by boxes";
    return formatted("  space %d%s: %s, %s; at most %d geoms, %lu pairs", counts.number,
                     counts.number >= last_space_with_line ? " and later ones" : "", kind, served, counts.most_geoms,
                     counts.reported) +
           times_line("dSpaceCollide", counts.collide) + times_line("dSpaceCollide2", counts.collide2) + "\n";
}

std::string counters_line(const dPredictiveSpaceStats &stats)
{
    return formatted("    ticks %lu, moved %lu, violations %lu, repredictions %lu, scheduled %lu, "
                     "woken %lu, near %lu, scans %lu, bytes %lu\n",
                     stats.ticks, stats.moved, stats.violations, stats.repredictions, stats.scheduled, stats.woken,
                     stats.near, stats.scans, stats.bytes);
}

std::string statistics(const std::deque<SpaceCounts> &spaces)
{
    std::string text;
    for (const SpaceCounts &counts : spaces)
    {
        text += space_line(counts);
        if (counts.stats.ticks > 0)
            text += counters_line(counts.stats);
    }
    return text;
}

std::string comparison(const std::deque<SpaceCounts> &spaces)
{
    unsigned long compared = 0, differences = 0;
    for (const SpaceCounts &counts : spaces)
    {
        compared += counts.compared;
        differences += counts.differences;
    }
    return formatted("  compared with all pairs: %lu collides, %lu differences\n", compared, differences);
}

bool written_to_file(const std::string &path, const std::string &text)
{
    OutputFile file(path);
    const bool written = file.write(text);
    return file.close() && written;
}

bool written_to_standard_error(const std::string &text)
{
    const NoSignalOfWriting quiet;
    return std::fputs(text.c_str(), stderr) >= 0 && std::fflush(stderr) == 0;
}
} // namespace

std::string report_text(const Settings &settings, const char *program, int process_id,
                        const std::deque<SpaceCounts> &spaces)
{
    std::string text;
    if (settings.stats)
        text += statistics(spaces);
    if (settings.compare)
        text += comparison(spaces);
    if (text.empty())
        return text;
    return formatted("ode_predictive_space: %s (process %d)\n", printable(program).c_str(), process_id) + text;
}

bool write_report(const Settings &settings, const std::string &text)
{
    if (text.empty())
        return true;
    if (settings.stats_file.empty())
        return written_to_standard_error(text);
    const bool written = written_to_file(settings.stats_file, text);
    if (!written)
        written_to_standard_error(text);
    return written;
}
} // namespace ode_predictive_space::preload
