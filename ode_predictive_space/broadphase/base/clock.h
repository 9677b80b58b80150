// Time in ticks: when does it pass?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_CLOCK_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_CLOCK_H

#include "ode_predictive_space/broadphase/base/id_set.h"

namespace ode_predictive_space
{
/// While nothing moves, no time passes. A program that asks between its step and its tick is recognised by the moves: when most
/// objects that were predicted to move have moved, it has stepped its world.
class Clock
{
public:
    Tick now() const { return now_; }

    /// The tick of the next update, as far as is known: reported moves are judged by where objects should be then.
    Tick expected() const { return expected_; }

    /// An update begins.
    ///
    /// @param is_tick a tick of the program, not a question between ticks.
    /// @param any_moved `moved` is not empty.
    /// @return true when a tick has passed.
    bool advance(bool is_tick, bool any_moved, const IdSet &moved, const IdSet &moving)
    {
        const bool passes = any_moved && ((is_tick && !ticked_early_) || most_have_moved(moved, moving));
        ticked_early_ = !is_tick && (ticked_early_ || passes);
        now_ += passes;
        expected_ = now_ + (ticked_early_ ? 0 : 1);
        return passes;
    }

private:
    static bool most_have_moved(const IdSet &moved, const IdSet &moving)
    {
        std::size_t expected = 0, seen = 0;
        for (std::size_t i = 0; i < moving.words(); ++i)
        {
            expected += IdSet::count(moving.word(i));
            seen += IdSet::count(moving.word(i) & moved.word(i));
        }
        return expected > 0 && 2 * seen >= expected;
    }

    Tick now_ = 0;
    Tick expected_ = 1;
    bool ticked_early_ = false; // time has already passed since the last tick, in a question
};
} // namespace ode_predictive_space

#endif
