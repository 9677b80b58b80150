#include "demos/runs/progress.h"

#include "demos/runs/table.h"

#include <cstdio>
#include <unistd.h>

namespace ode_predictive_space::worlds
{
Progress::Progress(std::string what, int ticks)
    : what_(std::move(what)), ticks_(ticks), terminal_(isatty(STDERR_FILENO) != 0)
{}

Progress::~Progress()
{
    if (terminal_)
        std::fputs("\r\x1b[K", stderr);
}

void Progress::show(int ticks_done)
{
    const int tenths = static_cast<int>(10.0 * ticks_done / ticks_);
    if (terminal_)
    {
        std::fprintf(stderr, "\r%s\x1b[K", line(ticks_done).c_str());
        std::fflush(stderr);
    }
    else if (tenths > tenths_shown_ && seconds_between(last_shown_, Clock::now()) > 1)
    {
        std::fprintf(stderr, "%s\n", line(ticks_done).c_str());
        last_shown_ = Clock::now();
        tenths_shown_ = tenths;
    }
}

std::string Progress::line(int ticks_done) const
{
    const double elapsed = seconds_between(start_, Clock::now());
    const double left = elapsed * (ticks_ - ticks_done) / ticks_done;
    return what_ + ": " + grouped(static_cast<std::uint64_t>(ticks_done)) + " of " +
           grouped(static_cast<std::uint64_t>(ticks_)) + " ticks, about " + fixed(left, 0) + " s left";
}
} // namespace ode_predictive_space::worlds
