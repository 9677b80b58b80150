#ifndef ODE_PREDICTIVE_SPACE_RECORDING_ADVICE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_ADVICE_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ode_predictive_space/recording/space_kind.h"

namespace ode_predictive_space::recording
{
/// One kind of spaces, replayed several times. All times in microseconds per event.
struct ReplayedSpace
{
    SpaceKind kind;
    std::vector<double>
        costs;         ///< of each replay: collide and the notices before it; empty when the spaces end the program
    double spared = 0; ///< time of dCollide() for the callbacks that these spaces leave out
};

/// The program as it was recorded. Times in microseconds per event.
struct RecordedTick
{
    double whole = 0;                ///< processor time of the thread that collides, from one collide to the next
    double collide = 0;              ///< in the space, without callbacks
    double callbacks = 0;            ///< in the program's callbacks
    SpaceKind kind = SpaceKind::box; ///< of the spaces that it had while it was recorded
};

struct Findings
{
    std::size_t events = 0;
    SpaceKind own = SpaceKind::hash; ///< that the program made
    std::vector<ReplayedSpace> spaces;
    std::optional<RecordedTick> tick; ///< not known of a recording that was not made by the launcher
};

/// The saved part of a tick with the program's own spaces. Spaces are slower in the program than in a replay, whose data stay
/// in the processor's caches; assuming the same delay for all is cautious, as a space that reads more memory loses more.
struct Gain
{
    double share;  ///< median of the replays
    double spread; ///< largest less least
};

/// None if one of both kinds of spaces ends the program, or if ticks are unknown.
std::optional<Gain> gain_of(const Findings &findings, SpaceKind kind);

enum class Advice
{
    unknown, ///< too little is recorded, or the replays differ too much
    leave,   ///< the spaces that the program has
    use,     ///< predictive ones, by box
    use_by_shape
};

/// A gain below 2 % of a tick is none. A gain below twice the spread is not known.
Advice advice_for(const Findings &findings);

std::string sentence_for(const Findings &findings);
} // namespace ode_predictive_space::recording

#endif
