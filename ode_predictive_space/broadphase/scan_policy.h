// When does prediction not pay?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SCAN_POLICY_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SCAN_POLICY_H

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace ode_predictive_space
{
/// Counts how many objects break their predictions. When it is a large part of the scene for several ticks in a row, the
/// scene is swept as a whole instead, for a while that doubles as long as prediction keeps failing afterwards.
class ScanPolicy
{
public:
    bool scanning() const { return remaining_ > 0; }

    /// Says how a tick of prediction went; the first prediction of an object does not count as broken.
    ///
    /// @return true when the next ticks are to be scans, starting with this one.
    bool prediction_fails(std::size_t broken, std::size_t objects)
    {
        const bool bad = broken * bad_part > objects;
        bad_ticks_ = bad ? bad_ticks_ + 1 : 0;
        good_ticks_ = bad ? 0 : good_ticks_ + 1;
        if (good_ticks_ > proven)
            length_ = first_length;
        if (bad_ticks_ < tolerated)
            return false;
        remaining_ = length_;
        length_ = std::min(2 * length_, last_length);
        bad_ticks_ = 0;
        return true;
    }

    /// Counts a tick of scanning.
    ///
    /// @return true when it was the last one.
    bool scan_ends() { return --remaining_ == 0; }

    void stop() { remaining_ = 0; }

private:
    // A prediction costs about as much as sweeping so many objects.
    static constexpr std::size_t bad_part = 6;
    static constexpr int tolerated = 3;
    static constexpr int proven = 64;
    static constexpr std::uint32_t first_length = 16;
    static constexpr std::uint32_t last_length = 256;

    int bad_ticks_ = 0;
    int good_ticks_ = 0;
    std::uint32_t remaining_ = 0;
    std::uint32_t length_ = first_length;
};
} // namespace ode_predictive_space

#endif
