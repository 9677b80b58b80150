#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_PROGRESS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_PROGRESS_H

#include "demos/runs/world_run.h"

#include <string>

namespace ode_predictive_space::worlds
{
/// On a terminal, overwrites one line of standard error; otherwise writes a line for each tenth, at most one per second.
class Progress
{
public:
    /// @param what the beginning of the line. @param ticks the whole work.
    Progress(std::string what, int ticks);
    ~Progress();
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    void show(int ticks_done);

private:
    std::string line(int ticks_done) const;

    std::string what_;
    int ticks_;
    bool terminal_;
    int tenths_shown_ = 0;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_ = start_;
};
} // namespace ode_predictive_space::worlds

#endif
