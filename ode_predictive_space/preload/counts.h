// The counts of a space.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_COUNTS_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_COUNTS_H

#include <cstdint>

#include "ode_predictive_space/predictive_space.h"

namespace ode_predictive_space::preload
{
/// A histogram of durations. A bucket is a nanosecond wide below 32 ns, and from there on 16 buckets go to each doubling, up to
/// 4.29 s; what is longer counts as that. All zeros: empty.
class Durations
{
public:
    void add(double seconds);

    /// @return seconds, at most 1/32 or half a nanosecond off where nothing was longer than 4.29 s; 0 when empty.
    double median() const;

private:
    static constexpr unsigned bits = 4; // of a number that tell its bucket, after the first 1
    static constexpr unsigned bucket_count = (32 - bits + 1) << bits;
    static unsigned bucket_of(std::uint32_t nanoseconds);

    std::uint32_t buckets_[bucket_count]; // each stays at its largest number
};

/// Calls of one function. Times in seconds.
struct CallTimes
{
    unsigned long calls;
    double total; ///< in the space, without the program's callbacks
    double largest;
    double in_callbacks;
    Durations durations;

    void add(double seconds, double callback_seconds);
};

/// The counts of a space in a process.
struct SpaceCounts
{
    int number;      ///< in the order in which the process made them, from 1
    int space_class; ///< as the program sees it
    int predictive;  ///< 1; 0: ODE's own
    int proximity;   ///< at the last collide
    int most_geoms;
    unsigned long reported; ///< callbacks
    CallTimes collide, collide2;
    unsigned long compared, differences;
    dPredictiveSpaceStats stats; ///< of a predictive one, when it was last collided
};

/// From this space of a process on, all share one line: a program may make any number of them.
constexpr int last_space_with_line = 1000;
} // namespace ode_predictive_space::preload

#endif
