#include "ode_predictive_space/recording/check.h"

#include <algorithm>

#include "ode_predictive_space/recording/formatted.h"

namespace ode_predictive_space::recording
{
namespace
{
Verdict compare_left_out(const Pairs &pairs, const Pairs &simple)
{
    if (pairs.lost_contacts > 0 || pairs.strange > 0)
        return {false, formatted("%llu pairs with a contact are left out, %llu are too many",
                                 static_cast<unsigned long long>(pairs.lost_contacts),
                                 static_cast<unsigned long long>(pairs.strange))};
    std::uint64_t left_out = 0;
    for (std::size_t i = 0; i < std::min(pairs.events.size(), simple.events.size()); ++i)
        left_out += simple.events[i].count - std::min(pairs.events[i].count, simple.events[i].count);
    return {true,
            formatted("all with a contact; %llu without one are left out", static_cast<unsigned long long>(left_out))};
}
} // namespace

std::string completeness_of(const Recording &recording)
{
    if (recording.reached_limit())
        return "The recording is whole. It ended at its limit of bytes.";
    if (recording.has_end())
        return "The recording is whole.";
    if (recording.records().empty())
        return formatted("The recording is empty: the file has %zu bytes and no whole record.", recording.bytes());
    return formatted("The recording is cut at event %zu, byte %zu of %zu: the program was killed, crashed or started "
                     "another program in "
                     "its place, or disk or memory was full. The whole records are used.",
                     recording.events().size(), recording.whole_bytes(), recording.bytes());
}

std::string unknown_notices(const Recording &recording)
{
    if (recording.state_of_first_space().service.predictive)
        return "";
    return std::string("The recording does not say how often poses were set, as ") +
           (recording.version() == 1 ? "its format is version 1" : "spaces of ODE were recorded") +
           ": one notice is replayed for each geom that has moved.";
}

Verdict compare(const Recording &recording, SpaceKind kind, const Pairs &pairs, const Pairs &expected,
                SpaceKind reference)
{
    if (!pairs.failure.empty())
        return {false, formatted("ended at event %zu: %s", pairs.events.size(), pairs.failure.c_str())};
    if (leaves_out_pairs(kind))
        return compare_left_out(pairs, expected);
    const std::size_t events = std::min(pairs.events.size(), expected.events.size());
    const bool may_have_more = kind == SpaceKind::own || kind == SpaceKind::quadtree || kind == SpaceKind::sap;
    std::size_t differing = 0, first = 0, with_unbounded = 0;
    for (std::size_t i = events; i-- > 0;)
    {
        if (pairs.events[i] == expected.events[i])
            continue;
        ++with_unbounded;
        if (may_have_more && pairs.events[i].same_but_more_unbounded(expected.events[i]))
            continue;
        ++differing;
        first = i;
    }
    if (differing == 0)
        return {true, with_unbounded == 0
                          ? "the same"
                          : "the same, but more with geoms that have no bounds (planes, nested spaces)"};
    return {false, formatted("other pairs in %zu events, first in event %zu", differing, first) +
                       differing_pairs(recording, kind, reference, first)};
}

std::string compared_with_program(const Recording &recording, const Pairs &expected, SpaceKind reference)
{
    std::size_t known = 0, differing = 0, first = 0;
    for (std::size_t i = std::min(recording.events().size(), expected.events.size()); i-- > 0;)
    {
        const EventSummary &event = recording.events()[i];
        known += event.has_pairs;
        if (event.has_pairs && !(expected.events[i] == EventPairs{event.pairs, event.hash, 0, 0}))
        {
            ++differing;
            first = i;
        }
    }
    if (known == 0)
        return "";
    if (differing == 0)
        return formatted("The program got the pairs of %s spaces in all of its %zu events.", name_of(reference), known);
    return formatted(
        "The program got other pairs than %s spaces give here in %zu of %zu events, first in event %zu "
        "(%u instead of %u pairs): its callbacks move or remove geoms, its spaces leave pairs out, they report more "
        "pairs with geoms that have no bounds, or they are wrong.",
        name_of(reference), differing, known, first, recording.events()[first].pairs, expected.events[first].count);
}
} // namespace ode_predictive_space::recording
