#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_ONCE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_ONCE_H

#include "ode_predictive_space/haptics/loop.h"

#include <functional>
#include <utility>

namespace ode_predictive_space::haptics
{
/// An event at the first call from a time on. It can be the callback of a step or of a driver.
class Once
{
public:
    Once(const LoopClock &clock, double time, std::function<void()> event)
        : clock_(clock), time_(time), event_(std::move(event))
    {}

    void operator()(double = 0)
    {
        if (at > 0 || clock_.now() < time_)
            return;
        at = clock_.now();
        event_();
    }

    double at = 0; ///< s; of the event, 0 before it

private:
    const LoopClock &clock_;
    double time_; ///< s
    std::function<void()> event_;
};
} // namespace ode_predictive_space::haptics

#endif
