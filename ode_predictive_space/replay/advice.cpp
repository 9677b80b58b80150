#include "ode_predictive_space/replay/advice.h"

#include <algorithm>

#include "ode_predictive_space/replay/formatted.h"

namespace ode_predictive_space::replay
{
namespace
{
// Fewer collides are mostly the first ones, in which a predictive space has yet to make its envelopes.
constexpr std::size_t fewest_events = 50;

// What runs differ by on a busy machine, and what no program notices.
constexpr double least_gain = 0.1;
constexpr double least_microseconds = 1;
constexpr double noticed_share = 0.01; // of the callbacks

double with_spared_callbacks(const Findings &findings)
{
    return findings.shape - findings.spared_time;
}

bool is_worth(double before, double now)
{
    return before - now >= std::max(least_gain * before, least_microseconds);
}

std::string said_of_shape(const Findings &findings)
{
    const std::string shape = readable(findings.shape) + " \xc2\xb5s by shape, ";
    if (findings.spared < noticed_share * findings.callbacks)
        return shape + "which spares less than 1 % of the callbacks";
    return shape + "which also spares " + readable(findings.spared) + " of " + readable(findings.callbacks) +
           " callbacks (" + readable(findings.spared_time) + " \xc2\xb5s in dCollide)";
}

const char *reason_to_leave(const Findings &findings)
{
    const double best = std::min(findings.box, with_spared_callbacks(findings));
    if (findings.own < least_microseconds)
        return "there is nothing to gain";
    return best < findings.own ? "the gain is too small to notice" : "predictive spaces are not faster here";
}
} // namespace

Advice advice_for(const Findings &findings)
{
    if (findings.events < fewest_events)
        return Advice::unknown;
    const double by_shape = with_spared_callbacks(findings);
    if (!is_worth(findings.own, std::min(findings.box, by_shape)))
        return Advice::leave;
    return is_worth(findings.box, by_shape) ? Advice::use_by_shape : Advice::use;
}

std::string sentence_for(const Findings &findings)
{
    const std::string option = findings.own_is_simple ? " --space all" : "";
    const std::string own =
        readable(findings.own) + " \xc2\xb5s in the program's own spaces (" + findings.own_name + ")";
    const std::string figures = "a collide and the moves before it take " + own + ", " + readable(findings.box) +
                                " \xc2\xb5s in predictive ones, " + said_of_shape(findings) + ".";
    switch (advice_for(findings))
    {
    case Advice::unknown:
        return "Not known: only " + std::to_string(findings.events) + " collides and questions were recorded.";
    case Advice::leave:
        return std::string("Leave it, as ") + reason_to_leave(findings) + ": " + figures;
    case Advice::use:
        return "Use it (ode-predictive-run" + option + "): " + figures;
    case Advice::use_by_shape:
        return "Use it by shape (ode-predictive-run" + option + " --proximity shape): " + figures;
    }
    return "";
}
} // namespace ode_predictive_space::replay
