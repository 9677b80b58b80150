// How often there is time to step the scene. In: how long its steps took. Out: how many of them half of a period has time for.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_STEP_BUDGET_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_STEP_BUDGET_H

#include <algorithm>
#include <optional>

namespace ode_predictive_space::haptics
{
/// Times in s.
class StepBudget
{
public:
    /// @param took a step, with all that the loop and the program do for it.
    void note(double took) { longest_ = std::max(took, forgetting * longest_.value_or(0)); }

    /// At least one; no more as long as nothing was measured.
    int affordable(double period) const
    {
        return longest_ ? static_cast<int>(std::clamp(0.5 * period / std::max(*longest_, shortest), 1.0, enough)) : 1;
    }

private:
    static constexpr double forgetting = 0.95; ///< from step to step, of a step that was longer than the others
    static constexpr double shortest = 1e-6;
    static constexpr double enough = 100;

    std::optional<double> longest_; ///< of late
};
} // namespace ode_predictive_space::haptics

#endif
