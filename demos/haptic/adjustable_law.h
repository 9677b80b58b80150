#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ADJUSTABLE_LAW_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ADJUSTABLE_LAW_H

#include "demos/haptic/demo_device.h"
#include "demos/haptic/options.h"
#include "ode_predictive_space/haptics/force_law.h"

#include <atomic>
#include <memory>

namespace ode_predictive_space::demo
{
/// The law of the options; in a replay, unless they name one, that of the recording.
std::string law_name(const Options &options, DemoDevice &device);

/// A law with a stiffness that any thread may set. Forces in the scene and at the hand are equal, but the probe moves `scale`
/// times as far as the hand, so the stiffness at the hand is the scale times that in the scene.
class AdjustableLaw : public haptics::ForceLaw
{
public:
    /// @param name of the law. @param scale metres of the scene per metre of the hand. @param rate Hz; of the servo.
    AdjustableLaw(const std::string &name, const Options &options, double scale, const haptics::Capabilities &device,
                  double rate);

    /// Takes effect from the next tick on. Any thread may call this. @param stiffness N/m at the hand, >= 0 and finite.
    void wish_stiffness(double stiffness) { wish_.store(stiffness / scale_, std::memory_order_relaxed); }

    double scale() const { return scale_; }
    double at_hand(double stiffness) const { return stiffness * scale_; } ///< N/m; of a stiffness in the scene
    double stiffest() const { return stiffest_; } ///< N/m, at the hand: what the device can render

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
    double scale_;
    double stiffest_;
    std::unique_ptr<ForceLaw> law_;
    std::atomic<double> wish_;
};
} // namespace ode_predictive_space::demo

#endif
