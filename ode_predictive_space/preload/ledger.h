#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_LEDGER_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_LEDGER_H

#include <deque>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

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
    std::vector<float> first_calls; ///< of the first million, each; for the median

    void add(double seconds, double callback_seconds);
    double median() const;
};

/// What is known of a space that the program made.
struct SpaceRecord
{
    int number;      ///< in the order in which they were made, from 1
    int space_class; ///< as the program sees it
    bool predictive;
    int proximity = dPredictiveProximityBox;
    int most_geoms = 0;
    unsigned long reported = 0; ///< callbacks
    CallTimes collide, collide2;
    unsigned long compared = 0, differences = 0;
    dPredictiveSpaceStats stats = {}; ///< of a predictive one, when it was last collided
};

/// All spaces of the process. What is said of a space remains when it is destroyed. Calls from several threads are safe.
class Ledger
{
public:
    /// A space was made, perhaps where one was that is gone.
    void made(dSpaceID space);

    /// Changes a space's record; it is made when the space is not known.
    ///
    /// @return what `change` returns.
    template <typename Change> auto with(dSpaceID space, Change change)
    {
        const std::lock_guard<std::mutex> guard(mutex_);
        return change(record_of(space));
    }

    /// Keeps all other threads out: a process that forks takes the lock with it, and of its threads only the one that forks.
    void lock() { mutex_.lock(); }
    void unlock() { mutex_.unlock(); }

    /// What there is to say at the end: for each space a line, for a predictive one that was collided a second.
    std::string statistics();

    /// One line: how much was compared, and what was found.
    std::string comparison();

private:
    SpaceRecord &record_of(dSpaceID space);
    SpaceRecord &enter(dSpaceID space);

    std::mutex mutex_;
    std::deque<SpaceRecord> records_;
    std::unordered_map<dSpaceID, SpaceRecord *> current_;
};
} // namespace ode_predictive_space::preload

#endif
