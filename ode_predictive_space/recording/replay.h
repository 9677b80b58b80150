#ifndef ODE_PREDICTIVE_SPACE_RECORDING_REPLAY_H
#define ODE_PREDICTIVE_SPACE_RECORDING_REPLAY_H

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/space_kind.h"

namespace ode_predictive_space::recording
{
struct EventPairs
{
    std::uint32_t count;
    std::uint64_t hash;      ///< sum of hash_of_pair()
    std::uint32_t unbounded; ///< pairs with a space, or with a geom whose box is infinite
    std::uint64_t hash_of_unbounded;
    bool operator==(const EventPairs &other) const { return count == other.count && hash == other.hash; }

    /// ODE's sweep-and-prune spaces report unbounded geoms with everything; they and quadtrees are unbounded in other spaces.
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
    // Only for a kind of spaces that leaves out pairs:
    std::uint64_t lost_contacts = 0; ///< pairs with a contact that are left out
    std::uint64_t strange = 0;       ///< pairs that the spaces by box do not have, or that are reported twice
};

Pairs find_pairs(const Recording &recording, SpaceKind kind);

/// The first pairs of an event that only one of two kinds finds: ": geoms 3 and 7 only in hash, ..."; empty without any.
std::string differing_pairs(const Recording &recording, SpaceKind kind, SpaceKind reference, std::size_t event);

/// Times in seconds.
struct MeasuredEvent
{
    float collide; ///< with a callback that only counts
    float
        notices; ///< for the changes before it: moves, sizes, bits, new geoms. They take some time without a space, too
    std::uint32_t callbacks;
};

struct Cost
{
    std::string failure;
    std::vector<MeasuredEvent> events; ///< that were replayed
    double processor_time = 0;         ///< of the whole process from the first event on, in seconds
};

/// @param most_events no more are replayed. @param most_seconds no event begins later.
Cost measure(const Recording &recording, SpaceKind kind, std::size_t most_events, double most_seconds);

/// Keeps the lesser time of two replays for each event, because the machine may be interrupted.
void take_least(const Cost &again, Cost &cost);

/// Callbacks of predictive spaces by box, and the contacts that dCollide() finds for them.
struct Callbacks
{
    std::uint64_t all = 0;
    std::uint64_t nothing = 0; ///< dCollide() finds no contact
    std::uint64_t unknown = 0; ///< with a space, or with a geom of which only the box is recorded
    double seconds_spared = 0; ///< time of dCollide() for pairs that spaces by shape leave out
};

/// @return why the replay ended early; empty: it did not.
std::string judge_callbacks(const Recording &recording, std::size_t most_events, double most_seconds,
                            Callbacks &callbacks);

struct CountedEvents
{
    std::size_t from = 0;      ///< first event
    std::size_t to = SIZE_MAX; ///< end of the range
    std::size_t every = 1;     ///< each nth event of the range
    bool contacts = false;     ///< also a dCollide() for each callback
    bool whole_life = false;   ///< also the making of all geoms, and their end
    bool has(std::size_t event) const { return event >= from && event < to && (event - from) % every == 0; }

    std::size_t count_of(std::size_t events) const
    {
        return from < std::min(to, events) ? (std::min(to, events) - from - 1) / every + 1 : 0;
    }
};

/// Replays in this process, for callgrind, which counts in the functions counted_changes, counted_collide and counted_end.
void replay_to_be_counted(const Recording &recording, SpaceKind kind, const CountedEvents &events = {});
} // namespace ode_predictive_space::recording

#endif
