// A function that is called at the end of a scope. One that captures at most two pointers needs no allocation.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_AT_END_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_AT_END_H

#include <functional>
#include <utility>

namespace ode_predictive_space::haptics
{
/// Assignment swaps the functions.
class AtEnd
{
public:
    AtEnd() = default;
    explicit AtEnd(std::function<void()> work) : work_(std::move(work)) {}
    AtEnd(AtEnd &&other) noexcept { work_.swap(other.work_); }
    AtEnd &operator=(AtEnd &&other) noexcept
    {
        work_.swap(other.work_);
        return *this;
    }
    ~AtEnd()
    {
        if (work_)
            work_();
    }

private:
    std::function<void()> work_; ///< must not throw
};
} // namespace ode_predictive_space::haptics

#endif
