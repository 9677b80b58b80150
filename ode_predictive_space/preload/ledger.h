#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_LEDGER_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_LEDGER_H

#include <deque>
#include <mutex>
#include <unordered_map>

#include "ode_predictive_space/preload/counts.h"

namespace ode_predictive_space::preload
{
/// A space that the program made.
struct KnownSpace
{
    int number;                   ///< in the order in which they were made, from 1
    bool is_substitute;           ///< a predictive space in the place of the one of ODE's that the program asked for
    SpaceCounts *counts;          ///< of this process; 0: none yet
    dPredictiveSpaceStats latest; ///< its own, of a predictive one, when it was last collided
    dPredictiveSpaceStats before_fork; ///< what of them belongs to the process that this one was forked from
};

/// All spaces of the process. What is counted of a space remains when it is destroyed. Calls from several threads are safe.
class Ledger
{
public:
    /// A space was made, perhaps where one was that is gone.
    void made(dSpaceID space, bool is_substitute);

    bool is_substitute(dSpaceID space) const;

    /// Changes what is known of a space, which has counts then.
    ///
    /// @return what `change` returns.
    template <typename Change> auto with(dSpaceID space, Change change)
    {
        const std::lock_guard<std::mutex> guard(mutex_);
        return change(known(space));
    }

    /// Keeps all other threads out: a process that forks takes the lock with it, and of its threads only the one that forks.
    void lock() { mutex_.lock(); }
    void unlock() { mutex_.unlock(); }

    /// This process was forked, with the lock: it begins to count, and leaves to its parent what was counted before.
    void begin_in_child();

    /// The counts of this process's spaces, in the order in which they began.
    std::deque<SpaceCounts> all() const;

private:
    KnownSpace &known(dSpaceID space);
    KnownSpace &enter(dSpaceID space, bool is_substitute);
    SpaceCounts *begin_counts(dSpaceID space, int number);

    mutable std::mutex mutex_;
    std::deque<SpaceCounts> counts_;
    std::unordered_map<dSpaceID, KnownSpace> current_;
    int made_ = 0;
};

/// The work of a space since an earlier reading of its statistics.
dPredictiveSpaceStats since(const dPredictiveSpaceStats &before, dPredictiveSpaceStats now);
} // namespace ode_predictive_space::preload

#endif
