#include "ode_predictive_space/recording/advice.h"

#include <algorithm>

#include "ode_predictive_space/recording/formatted.h"

namespace ode_predictive_space::recording
{
namespace
{
// Minimum number of collides for an advice: the first ones, in which a predictive space makes its envelopes, must not dominate.
constexpr std::size_t fewest_events = 50;
constexpr double least_gain = 0.02; // of a tick

const ReplayedSpace *replayed(const Findings &findings, SpaceKind kind)
{
    for (const ReplayedSpace &space : findings.spaces)
        if (space.kind == kind && !space.costs.empty())
            return &space;
    return nullptr;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

bool is_clear(const Gain &gain)
{
    return gain.share >= 2 * gain.spread;
}

bool is_worth(const std::optional<Gain> &gain)
{
    return gain && gain->share >= least_gain && is_clear(*gain);
}

std::optional<SpaceKind> best_of_ode(const Findings &findings)
{
    std::optional<SpaceKind> best;
    for (const SpaceKind kind : {SpaceKind::simple, SpaceKind::hash, SpaceKind::quadtree, SpaceKind::sap})
        if (const auto gain = gain_of(findings, kind);
            kind != findings.own && gain && (!best || gain->share > gain_of(findings, *best)->share))
            best = kind;
    return best;
}

std::string percent(double share)
{
    return formatted("%.*f %%", share < 0.1 ? 1 : 0, 100 * share);
}

std::string longer_or_shorter(double gain)
{
    return gain < 0 ? percent(-gain) + " longer" : percent(gain) + " shorter";
}

const char *call_of(SpaceKind kind)
{
    switch (kind)
    {
    case SpaceKind::simple:
        return "dSimpleSpaceCreate(parent)";
    case SpaceKind::quadtree:
        return "dQuadTreeSpaceCreate(parent, ...)";
    case SpaceKind::sap:
        return "dSweepAndPruneSpaceCreate(parent, ...)";
    default:
        return "dHashSpaceCreate(parent)";
    }
}

std::string line_to_change(const Findings &findings, Advice advice)
{
    const std::string by_shape = "dPredictiveSpaceSetProximity(space, dPredictiveProximityShape)";
    if (is_predictive(findings.own))
        return "Call " + by_shape + ".";
    std::string text = std::string("Write dPredictiveSpaceCreate(parent) for ") + call_of(findings.own);
    if (advice == Advice::use_by_shape)
        text += ", and call " + by_shape;
    return text + ", or start the program by ode-predictive run" +
           (findings.own == SpaceKind::simple ? " --space all" : "") +
           (advice == Advice::use_by_shape ? " --proximity shape." : ".");
}

// The tick with the program's own spaces.
double whole_tick(const Findings &findings)
{
    const ReplayedSpace *own = replayed(findings, findings.own), *recorded = replayed(findings, findings.tick->kind);
    return own && recorded ? findings.tick->whole + median(own->costs) - median(recorded->costs) : 0;
}

std::string shares_of_tick(const Findings &findings)
{
    const RecordedTick &tick = *findings.tick;
    return formatted(
        "For the recording it ran in %s spaces: a tick took %s \xc2\xb5s, %s of it in collides, %s in callbacks.",
        is_predictive(tick.kind) ? "predictive" : name_of(tick.kind), readable(tick.whole).c_str(),
        percent(tick.collide / tick.whole).c_str(), percent(tick.callbacks / tick.whole).c_str());
}

std::string said_of_ode(const Findings &findings)
{
    const std::optional<SpaceKind> best = best_of_ode(findings);
    if (!best)
        return "";
    return std::string(" With the best of ODE's ") + (is_predictive(findings.own) ? "" : "other ") + "spaces, " +
           name_of(*best) + ", a tick would be " + longer_or_shorter(gain_of(findings, *best)->share) +
           " than with its own.";
}

std::string said_of_gain(const Findings &findings, SpaceKind kind)
{
    const Gain gain = *gain_of(findings, kind);
    return "a tick would be " + longer_or_shorter(gain.share) + " (five replays differ by " + percent(gain.spread) +
           ")";
}

std::string sentence_without_ticks(const Findings &findings)
{
    std::string text =
        "What a tick would gain is not known, as the recording has no times of the program. A collide and the notices "
        "before it take";
    for (const SpaceKind kind : {findings.own, SpaceKind::box, SpaceKind::shape})
        if (const ReplayedSpace *space = replayed(findings, kind))
            text += formatted("%s %s \xc2\xb5s in %s", kind == findings.own ? "" : ",",
                              readable(median(space->costs) - space->spared).c_str(), name_of(kind));
    return text + ".";
}
} // namespace

std::optional<Gain> gain_of(const Findings &findings, SpaceKind kind)
{
    const ReplayedSpace *own = replayed(findings, findings.own), *other = replayed(findings, kind);
    const double whole = findings.tick ? whole_tick(findings) : 0;
    if (!own || !other || whole <= 0)
        return std::nullopt;
    std::vector<double> shares;
    for (std::size_t i = 0; i < std::min(own->costs.size(), other->costs.size()); ++i)
        shares.push_back((own->costs[i] - other->costs[i] + other->spared - own->spared) / whole);
    const auto [least, largest] = std::minmax_element(shares.begin(), shares.end());
    return Gain{median(shares), *largest - *least};
}

Advice advice_for(const Findings &findings)
{
    const auto by_box = gain_of(findings, SpaceKind::box), by_shape = gain_of(findings, SpaceKind::shape);
    if (findings.events < fewest_events || !by_box)
        return Advice::unknown;
    const bool shape_is_worth = findings.own != SpaceKind::shape && is_worth(by_shape);
    const bool box_is_worth = findings.own != SpaceKind::box && is_worth(by_box);
    if (shape_is_worth && by_shape->share - by_box->share >= std::max(least_gain, 2 * by_shape->spread))
        return Advice::use_by_shape;
    if (box_is_worth)
        return Advice::use;
    return is_predictive(findings.own) || by_box->share < least_gain ? Advice::leave : Advice::unknown;
}

std::string sentence_for(const Findings &findings)
{
    if (findings.events < fewest_events)
        return "Not known: only " + std::to_string(findings.events) +
               " collides were recorded. Record the program for longer.";
    if (!findings.tick || !gain_of(findings, SpaceKind::box))
        return sentence_without_ticks(findings);
    const Advice advice = advice_for(findings);
    const std::string rest = ". " + shares_of_tick(findings) + said_of_ode(findings);
    switch (advice)
    {
    case Advice::use:
        return "Use predictive spaces: " + said_of_gain(findings, SpaceKind::box) + ". " +
               line_to_change(findings, advice) + rest.substr(1);
    case Advice::use_by_shape:
        return "Use predictive spaces by shape: " + said_of_gain(findings, SpaceKind::shape) + ". " +
               line_to_change(findings, advice) + rest.substr(1);
    case Advice::unknown:
        return "Not known: in predictive spaces " + said_of_gain(findings, SpaceKind::box) +
               ". Measure again on an idle machine" + rest;
    case Advice::leave:
        if (is_predictive(findings.own))
            return std::string("Keep the program's spaces: they are predictive, by ") + name_of(findings.own) + rest;
        return "Keep the program's spaces: in predictive ones " + said_of_gain(findings, SpaceKind::box) + rest;
    }
    return "";
}
} // namespace ode_predictive_space::recording
