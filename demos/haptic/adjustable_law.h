// A force law whose stiffness can be changed while it runs.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ADJUSTABLE_LAW_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ADJUSTABLE_LAW_H

#include "ode_predictive_space/haptics/force_law.h"

#include <atomic>
#include <memory>

namespace ode_predictive_space::demo
{
/// Another law, and a stiffness that any thread may set.
class AdjustableLaw : public haptics::ForceLaw
{
public:
    explicit AdjustableLaw(std::unique_ptr<ForceLaw> law) : law_(std::move(law)), wish_(law_->stiffness()) {}

    /// Takes effect from the next tick on. From any thread. @param stiffness N/m in the scene, >= 0 and finite.
    void wish_stiffness(double stiffness) { wish_.store(stiffness, std::memory_order_relaxed); }

    void forces(const haptics::ToolState &tool, const std::vector<haptics::Touch> &touches, double dt,
                haptics::TouchForces &forces) override
    {
        const double wish = wish_.load(std::memory_order_relaxed);
        if (wish != law_->stiffness())
        {
            law_->set_stiffness(wish);
        }
        law_->forces(tool, touches, dt, forces);
    }

    haptics::TouchView view() const override { return law_->view(); }
    void reset() override { law_->reset(); }
    double stiffness() const override { return law_->stiffness(); }
    double damping() const override { return law_->damping(); }

    void set_stiffness(double stiffness) override
    {
        law_->set_stiffness(stiffness);
        wish_stiffness(stiffness);
    }

private:
    std::unique_ptr<ForceLaw> law_;
    std::atomic<double> wish_;
};
} // namespace ode_predictive_space::demo

#endif
