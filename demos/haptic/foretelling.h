// How well the space foretold what the probe would touch.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_FORETELLING_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_FORETELLING_H

#include <cstdint>
#include <map>
#include <vector>

namespace ode_predictive_space::demo
{
/// Something that the probe can meet.
struct Foretold
{
    std::uintptr_t object = 0;
    double seconds = 0; ///< from now, at the earliest
};

/// Of all touches that began.
struct ForetellingReport
{
    std::uint64_t touches = 0;
    std::uint64_t foretold = 0; ///< the object was among those that could be met, before it was near
    double mean_notice = 0;     ///< s; how long before the touch it was foretold first
    double mean_early =
        0; ///< s; how long before the touch lay the time that was foretold first. Negative: the probe came earlier
};

/// Compares what was foretold with what came.
class Foretelling
{
public:
    /// What the probe can meet, at this time.
    void foretold(double time, const std::vector<Foretold> &meetings);

    /// What the probe touches, at this time.
    void touching(double time, const std::vector<std::uintptr_t> &objects);

    ForetellingReport report() const;

private:
    /// From the moment when an object came into sight until it is out of it.
    struct Approach
    {
        double first_seen; ///< s
        double earliest;   ///< s; the time of meeting that was foretold then
        bool in_time;      ///< it was not near already
    };

    void count(double time, std::uintptr_t object);

    std::map<std::uintptr_t, Approach> approaches_;
    std::vector<std::uintptr_t> touched_; ///< in the tick before
    std::uint64_t touches_ = 0;
    std::uint64_t foretold_ = 0;
    double notice_sum_ = 0;
    double early_sum_ = 0;
};
} // namespace ode_predictive_space::demo

#endif
