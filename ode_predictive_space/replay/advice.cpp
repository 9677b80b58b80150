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
    if (findings.spared == 0)
        return formatted("%.3g \xc2\xb5s by shape, which spares no callback", findings.shape);
    return formatted("%.3g \xc2\xb5s by shape, which also spares %.3g of %.3g callbacks (%.3g \xc2\xb5s in dCollide)",
                     findings.shape, findings.spared, findings.callbacks, findings.spared_time);
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
    const char *option = findings.own_is_simple ? " --space all" : "";
    const std::string by_shape = said_of_shape(findings);
    switch (advice_for(findings))
    {
    case Advice::unknown:
        return formatted("Not known: only %zu collides and questions were recorded.", findings.events);
    case Advice::leave:
        return formatted("Leave it: it does not pay here. A collide and the moves before it take %.3g \xc2\xb5s in the "
                         "program's own spaces (%s), %.3g \xc2\xb5s in predictive ones, ",
                         findings.own, findings.own_name.c_str(), findings.box) +
               by_shape + ".";
    case Advice::use:
        return formatted("Use it (ode-predictive-run%s): a collide and the moves before it take %.3g \xc2\xb5s instead "
                         "of %.3g \xc2\xb5s in the "
                         "program's own spaces (%s); ",
                         option, findings.box, findings.own, findings.own_name.c_str()) +
               by_shape + ".";
    case Advice::use_by_shape:
        return formatted(
                   "Use it by shape (ode-predictive-run%s --proximity shape): a collide and the moves before it take "
                   "%.3g \xc2\xb5s in the program's own spaces (%s), %.3g \xc2\xb5s in predictive ones, ",
                   option, findings.own, findings.own_name.c_str(), findings.box) +
               by_shape + ".";
    }
    return "";
}
} // namespace ode_predictive_space::replay
