// When does prediction not pay, and when does it again?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SCAN_POLICY_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SCAN_POLICY_H

#include <algorithm>
#include <cstddef>

namespace ode_predictive_space
{
/// Counts how many objects break their predictions. When it is a large part of the scene for several ticks in a row, the
/// scene is swept as a whole instead, until it has been calm for some ticks; for more, each time that calm did not last.
class ScanPolicy
{
public:
    bool scanning() const { return scanning_; }

    /// Begins scanning because most objects are new: nothing is known yet of how they move.
    void begin()
    {
        scanning_ = at_beginning_ = true;
        streak_ = 0;
        required_calm_ = 1;
    }

    bool at_beginning() const { return at_beginning_; }

    /// Ends it because predictions are wanted.
    void end()
    {
        scanning_ = at_beginning_ = false;
        streak_ = 0;
    }

    /// Says how a tick of prediction went; the first prediction of an object does not count as broken.
    ///
    /// @return true when scanning begins, with this tick.
    bool prediction_fails(std::size_t broken, std::size_t objects)
    {
        const bool bad = broken * bad_part > objects;
        streak_ = bad == was_bad_ ? streak_ + 1 : 1;
        was_bad_ = bad;
        if (!bad && streak_ >= proven)
            required_calm_ = first_calm;
        scanning_ = bad && streak_ >= tolerated;
        if (scanning_)
            streak_ = 0;
        return scanning_;
    }

    /// Says how a tick of scanning went: whether enough objects moved as could have been predicted.
    ///
    /// @return true when scanning ends, with this tick.
    bool calm_returns(bool calm)
    {
        streak_ = calm ? streak_ + 1 : 0;
        if (streak_ < required_calm_)
            return false;
        end();
        required_calm_ = std::min(2 * required_calm_, last_calm);
        return true;
    }

    /// A prediction costs about as much as sweeping so many objects.
    static constexpr std::size_t bad_part = 6;

private:
    static constexpr int tolerated = 3;
    static constexpr int proven = 64;
    static constexpr int first_calm = 4;
    static constexpr int last_calm = 256;

    bool scanning_ = false;
    bool at_beginning_ = false;
    bool was_bad_ = false;
    int streak_ = 0;
    int required_calm_ = first_calm;
};
} // namespace ode_predictive_space

#endif
