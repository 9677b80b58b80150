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
    explicit AdjustableLaw(std::unique_ptr<ForceLaw> law) : law_(std::move(law)), wish_(law_->material().stiffness) {}

    /// Takes effect from the next tick on. From any thread. @param stiffness N/m in the scene, >= 0 and finite.
    void wish_stiffness(double stiffness) { wish_.store(stiffness, std::memory_order_relaxed); }

    void forces(const haptics::ToolState &tool, const std::vector<haptics::Touch> &touches, double dt,
                haptics::TouchForces &forces) override
    {
        law_->forces(tool, touches, dt, forces);
    }

    haptics::TouchView view() const override { return law_->view(); }
    const char *name() const override { return law_->name(); }
    void reset() override { law_->reset(); }

    haptics::Material material() const override
    {
        haptics::Material material = law_->material();
        material.stiffness = wish_.load(std::memory_order_relaxed);
        return material;
    }

private:
    std::unique_ptr<ForceLaw> law_;
    std::atomic<double> wish_;
};
} // namespace ode_predictive_space::demo

#endif
