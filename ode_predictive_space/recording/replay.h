// A recording in spaces of one kind after another: the pairs that they find, and what it takes them.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_REPLAY_H
#define ODE_PREDICTIVE_SPACE_RECORDING_REPLAY_H

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/space_kind.h"

namespace ode_predictive_space::recording
{
/// What one event gave.
struct EventPairs
{
    std::uint32_t count;
    std::uint64_t hash;      ///< sum of hash_of_pair()
    std::uint32_t unbounded; ///< of the pairs, those with a space or with a geom whose box has no end on some side
    std::uint64_t hash_of_unbounded;
    bool operator==(const EventPairs &other) const { return count == other.count && hash == other.hash; }

    /// ODE's sweep-and-prune spaces report what has no bounds with everything, and have no bounds within others, as quadtrees.
    bool same_but_more_unbounded(const EventPairs &other) const
    {
        return count - unbounded == other.count - other.unbounded &&
               hash - hash_of_unbounded == other.hash - other.hash_of_unbounded && unbounded >= other.unbounded;
    }
};

struct Pairs
{
    std::string failure; ///< why the replay ended early; empty: it did not
    std::vector<EventPairs> events;
    std::uint64_t lost_contacts = 0; ///< of a kind that leaves out pairs: those with a contact
    std::uint64_t strange = 0;       ///< and pairs that it has in addition, or twice
};

/// Replays without a clock.
Pairs find_pairs(const Recording &recording, SpaceKind kind);

/// Pairs of ids of one event that only one of two kinds of spaces has: (pair, the first has it).
using DifferentPairs = std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, bool>>;
DifferentPairs differing_pairs(const Recording &recording, SpaceKind first, SpaceKind second, std::size_t event);

/// What one kind of spaces takes. Times in seconds.
struct Cost
{
    std::string failure;
    std::size_t events = 0; ///< that were replayed
    double collides = 0;    ///< of all events, with a callback that only counts
    double notices = 0;     ///< of the changes between them: moves, sizes, bits, new geoms; see without()
    std::uint64_t callbacks = 0;
    double processor_time = 0;  ///< of the process, from the first event on: with all that a replay does besides
    std::vector<float> seconds; ///< of each event
    std::vector<float> seconds_of_notices;   ///< before it
    std::vector<std::uint32_t> callbacks_of; ///< likewise
};

/// What the spaces take of it: the changes cost something without a space, too, and so does the replay.
///
/// @param none of SpaceKind::none, for the same events.
Cost without(const Cost &none, Cost cost);

/// Replays by the clock.
///
/// @param most_events no more than these. @param most_seconds no event begins later.
Cost measure(const Recording &recording, SpaceKind kind, std::size_t most_events, double most_seconds);

/// Of each event the lesser time of two replays, for the machine does other things in between.
void take_least(const Cost &again, Cost &cost);

/// The same, several times, and of each event the least time.
Cost measure_repeatedly(const Recording &recording, SpaceKind kind, std::size_t most_events, double most_seconds);

/// What the callbacks of spaces by boxes are good for. dCollide() is asked for 8 contacts.
struct Callbacks
{
    std::string failure;
    std::uint64_t all = 0;
    std::uint64_t nothing = 0; ///< dCollide() finds no contact
    std::uint64_t unknown = 0; ///< with a space, or with a geom of which only the box is recorded
    double seconds_spared = 0; ///< in those calls of dCollide() that spaces by shape spare
};
Callbacks judge_callbacks(const Recording &recording, std::size_t most_events, double most_seconds);

/// The events of a recording whose instructions count, and what else does.
struct CountedEvents
{
    std::size_t from = 0;      ///< the first one
    std::size_t to = SIZE_MAX; ///< the first one after them
    std::size_t every = 1;     ///< from one to the next
    bool contacts = false;     ///< dCollide() for each callback counts, too
    bool whole_life = false;   ///< the making of all geoms before the first event counts, and so does their end
    bool has(std::size_t event) const { return event >= from && event < to && (event - from) % every == 0; }

    /// How many of a recording with so many events.
    std::size_t count_of(std::size_t events) const
    {
        return from < std::min(to, events) ? (std::min(to, events) - from - 1) / every + 1 : 0;
    }
};

/// Replays in this process and counts nothing: for callgrind, which gets the names of the functions whose instructions
/// count, counted_changes, counted_collide and counted_end. What is before the first event, the making of all geoms, does not count
/// unless their whole life does.
void replay_to_be_counted(const Recording &recording, SpaceKind kind, const CountedEvents &events = {});
} // namespace ode_predictive_space::recording

#endif
