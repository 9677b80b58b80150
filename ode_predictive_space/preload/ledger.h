#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_LEDGER_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_LEDGER_H

#include <deque>
#include <mutex>
#include <string>
#include <unordered_map>

#include "ode_predictive_space/predictive_space.h"

namespace ode_predictive_space::preload
{
/// Calls of one function. Times in seconds.
struct CallTimes
{
    unsigned long calls = 0;
    double total = 0; ///< in the space, without the program's callbacks
    double largest = 0;
    double in_callbacks = 0;

    void add(double seconds, double callback_seconds);
};

struct SpaceCounts
{
    int number;                              ///< in the order in which the program made its spaces, from 1
    int space_class;                         ///< as the program sees it
    bool predictive;                         ///< false: ODE's own
    int proximity = dPredictiveProximityBox; ///< at the last collide
    int most_geoms = 0;
    unsigned long reported = 0; ///< callbacks
    CallTimes collide = {}, collide2 = {};
    dPredictiveSpaceStats stats = {}; ///< of a predictive one at its last collide
};

/// All spaces of the process. The counts of a space remain when it is destroyed. Calls from several threads are safe.
class Ledger
{
public:
    /// Adds a new space, which may have the address of a destroyed one.
    void made(dSpaceID space, bool is_substitute);

    /// Whether the space is a predictive one in place of a space of ODE that the program made.
    bool is_substitute(dSpaceID space) const;

    int number_of(dSpaceID space);

    template <typename Change> void with_counts(dSpaceID space, Change change)
    {
        const std::lock_guard<std::mutex> guard(mutex_);
        change(*known(space).counts);
    }

    /// Keeps all other threads out during a fork: the child inherits the lock, but only the forking thread.
    void lock() { mutex_.lock(); }
    void unlock() { mutex_.unlock(); }

    /// Releases the lock in a forked child, and counts the child's own calls from now on.
    void begin_in_child();

    /// A line per space with its calls and times; a predictive space has a second line with its counters. Empty without spaces.
    std::string statistics() const;

private:
    struct KnownSpace
    {
        int number;
        bool is_substitute;
        SpaceCounts *counts; // 0: none in this process yet
    };

    KnownSpace &known(dSpaceID space);
    KnownSpace &enter(dSpaceID space, bool is_substitute);
    SpaceCounts *begin_counts(dSpaceID space, int number);

    mutable std::mutex mutex_;
    std::deque<SpaceCounts> counts_;
    std::unordered_map<dSpaceID, KnownSpace> current_;
    int made_ = 0;
};
} // namespace ode_predictive_space::preload

#endif
