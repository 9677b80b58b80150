// What --watch and --report of the launcher show, from the pages in which the programs count.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_LIVE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_LIVE_H

#include <chrono>
#include <string>
#include <vector>

#include "ode_predictive_space/preload/counts_file.h"
#include "ode_predictive_space/preload/settings.h"
#include "ode_predictive_space/report/page.h"

namespace ode_predictive_space::preload
{
/// Sums over all spaces of all programs.
struct Totals
{
    std::size_t spaces = 0;
    unsigned long collides = 0; ///< calls of dSpaceCollide() and dSpaceCollide2()
    double seconds = 0;         ///< in them, without callbacks
    unsigned long pairs = 0;    ///< callbacks
};

Totals totals_of(const std::vector<SpaceCounts *> &pages);

/// Number of spaces and of collides; then, of the time between two readings, collides per second, mean time and mean number of
/// pairs of a collide. Cut off at 79 columns, so that a line of a terminal holds it.
std::string live_line(const Totals &before, const Totals &now, double elapsed_seconds);

/// Shows the totals on standard error: on a terminal in one line that is written over, elsewhere a line whenever there is
/// something new.
class LiveCounters
{
public:
    explicit LiveCounters(CountsFile &file);

    void show();
    void end(); ///< shows them once more, over the whole time

private:
    using Clock = std::chrono::steady_clock;
    void print(const Totals &since, const Totals &now, Clock::time_point begin);

    CountsFile &file_;
    bool terminal_;
    Clock::time_point begin_ = Clock::now(), latest_ = begin_;
    Totals before_;
};

/// The statistics of all processes, the time per dSpaceCollide() in the spaces that were collided most often, and what the run
/// does not tell.
///
/// @param command the program and its arguments, for the title.
/// @param still_running the processes that outlive the program; empty: none does.
report::Page page_of(const std::string &command, const std::vector<SpaceCounts *> &pages, const Settings &settings,
                     const std::string &still_running);
} // namespace ode_predictive_space::preload

#endif
