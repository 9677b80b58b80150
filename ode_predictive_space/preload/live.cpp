#include "ode_predictive_space/preload/live.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <tuple>

#include <unistd.h>

#include "ode_predictive_space/preload/report.h"
#include "ode_predictive_space/report/curves.h"

namespace ode_predictive_space::preload
{
namespace
{
constexpr std::size_t most_curves = 7; // as many as there are colours

std::string program_of(const SpaceCounts &counts)
{
    return {counts.program, strnlen(counts.program, sizeof counts.program)};
}

report::Plot plot_of(std::vector<SpaceCounts *> pages)
{
    std::sort(pages.begin(), pages.end(), [](const SpaceCounts *a, const SpaceCounts *b) {
        return std::tie(b->collide.calls, a->process_id, a->number) <
               std::tie(a->collide.calls, b->process_id, b->number);
    });
    pages.resize(std::min(pages.size(), most_curves));
    report::Plot plot{"Time per dSpaceCollide()", "number of the call", "microseconds", {}, true};
    for (const SpaceCounts *counts : pages)
        plot.curves.push_back(report::means(program_of(*counts) + " (process " + std::to_string(counts->process_id) +
                                                "), space " + std::to_string(counts->number) + ": " +
                                                name_of_space_class(counts->space_class) +
                                                (counts->predictive ? ", predictive" : ", ODE's own"),
                                            counts->collide_series, 1, 1e6));
    return plot;
}
} // namespace

Totals totals_of(const std::vector<SpaceCounts *> &pages)
{
    Totals totals;
    for (const SpaceCounts *counts : pages)
    {
        ++totals.spaces;
        totals.collides += counts->collide.calls + counts->collide2.calls;
        totals.seconds += counts->collide.total + counts->collide2.total;
        totals.pairs += counts->reported;
    }
    return totals;
}

std::string live_line(const Totals &before, const Totals &now, double elapsed_seconds)
{
    char text[80];
    const int length = std::snprintf(text, sizeof text, "ode-predictive-run: %zu space%s, %lu collides", now.spaces,
                                     now.spaces == 1 ? "" : "s", now.collides);
    const auto collides = static_cast<double>(now.collides - before.collides);
    if (collides > 0)
        std::snprintf(text + length, sizeof text - static_cast<std::size_t>(length), ", %.0f/s, %.3g us, %.3g pairs",
                      collides / elapsed_seconds, 1e6 * (now.seconds - before.seconds) / collides,
                      static_cast<double>(now.pairs - before.pairs) / collides);
    return text;
}

LiveCounters::LiveCounters(CountsFile &file) : file_(file), terminal_(isatty(STDERR_FILENO) != 0) {}

void LiveCounters::show()
{
    const Totals now = totals_of(file_.pages());
    if (terminal_ || now.collides != before_.collides)
        print(before_, now, latest_);
    before_ = now;
    latest_ = Clock::now();
}

void LiveCounters::end()
{
    print({}, totals_of(file_.pages()), begin_);
    if (terminal_)
        std::fputs("\n", stderr);
}

void LiveCounters::print(const Totals &since, const Totals &now, Clock::time_point begin)
{
    const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
    std::fprintf(stderr, terminal_ ? "\r%s\x1b[K" : "%s\n", live_line(since, now, elapsed).c_str());
}

report::Page page_of(const std::string &command, const std::vector<SpaceCounts *> &pages, const Settings &settings,
                     const std::string &still_running)
{
    Settings all = settings;
    all.stats = true;
    std::map<std::uint32_t, std::vector<SpaceCounts *>> processes;
    for (SpaceCounts *counts : pages)
        processes[counts->process].push_back(counts);
    std::string text;
    for (const auto &[number, spaces] : processes)
        text += report_text(all, program_of(*spaces.front()).c_str(), spaces.front()->process_id, spaces);
    text = text.empty() ? "No space of ODE was seen.\n" : text;
    if (!still_running.empty())
        text += "\nStill running when the program had ended, and counted up to then: " + still_running + "\n";
    return {"ode-predictive-run " + command, text, {plot_of(pages)}};
}
} // namespace ode_predictive_space::preload
