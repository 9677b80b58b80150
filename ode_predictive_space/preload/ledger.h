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

/// The counts of a space in this process.
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
    /// A space was made, perhaps at the address of one that is gone.
    void made(dSpaceID space, bool is_substitute);

    /// Is it a predictive space in the place of one of ODE's that the program asked for?
    bool is_substitute(dSpaceID space) const;

    /// The number of a space, as in its counts.
    int number_of(dSpaceID space);

    /// Changes the counts of a space.
    template <typename Change> void with_counts(dSpaceID space, Change change)
    {
        const std::lock_guard<std::mutex> guard(mutex_);
        change(*known(space).counts);
    }

    /// Keeps all other threads out: a process that forks takes the lock with it, and of its threads only the one that forks.
    void lock() { mutex_.lock(); }
    void unlock() { mutex_.unlock(); }

    /// This process was forked, with the lock: its calls are counted from now on.
    void begin_in_child();

    /// For each space a line with its calls and times, and for a predictive one a second line with its counters. Empty when the
    /// process had no space.
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
