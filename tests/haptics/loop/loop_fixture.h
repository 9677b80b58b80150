// A loop in simulated time, for the tests of both kinds of loops.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_LOOP_LOOP_FIXTURE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_LOOP_LOOP_FIXTURE_H

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/penalty_law.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/faulty_device.h"
#include "tests/haptics/support/once.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/scripted_device.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

namespace ode_predictive_space::haptics
{
constexpr double spring = 800;        // N/m
constexpr double depth = 0.004;       // m; depth of the probe in the plane
constexpr double grace = 0.010;       // s; longest time from a fault to zero force
constexpr double pressed_after = 1.8; // s; the force is complete from here on

inline RenderSettings usual_rendering()
{
    return with_stiffness(spring);
}

/// Rests for a second while the forces ramp in, then goes down into the plane z = 0.
inline Vector3 press_down(double seconds)
{
    const double u = std::clamp((seconds - 1) / 0.5, 0.0, 1.0);
    return {0, 0, 0.05 + u * u * u * (10 + u * (-15 + 6 * u)) * (radius - depth - 0.05)};
}

inline std::string name_of_loop(const testing::TestParamInfo<bool> &decoupled)
{
    return decoupled.param ? "Decoupled" : "SingleThreaded";
}

/// The parameter: whether the loop has two threads.
class HapticLoopTest : public testing::TestWithParam<bool>
{
protected:
    HapticLoopTest()
        : scripted_([this](double seconds) { return path_(seconds); }), device_(scripted_), log_(device_, clock_)
    {
        dCreatePlane(world_.space, 0, 0, 1, 0);
    }

    LoopSettings settings()
    {
        LoopSettings settings = simulated(clock_, 3, GetParam());
        settings.notice = notices_.sink();
        return settings;
    }

    void make(RenderSettings rendering = usual_rendering()) { make(std::move(rendering), settings()); }

    void make(RenderSettings rendering, const LoopSettings &settings)
    {
        probe_ = std::make_unique<HapticProbe>(log_, world_.space, radius, std::move(rendering));
        loop_ = std::make_unique<HapticLoop>(*probe_, settings);
    }

    /// Collides and steps; `also` is called in each step, with the clock's time.
    SceneWork work(std::function<void(double)> also = {})
    {
        return world_.work(*probe_, [this, also](double) {
            if (also)
                also(clock_.now());
        });
    }

    /// Expects the full force before the fault, and zero from soon after it to `until`.
    void expect_zero_force_after(double fault, double until)
    {
        EXPECT_NEAR(log_.force_at(fault - 0.001).z(), spring * depth, 1e-9) << "it was there before";
        EXPECT_TRUE(log_.was_quiet(fault + grace, until)) << log_.force_at(fault + grace).transpose();
    }

    const OdeUse ode_;
    SimulatedClock clock_;
    ProbeWorld world_;
    NoticeList notices_;
    ScriptedDevice::Path path_ = &press_down;
    ScriptedDevice scripted_;
    FaultyDevice device_;
    WriteLog log_;
    std::unique_ptr<HapticProbe> probe_;
    std::unique_ptr<HapticLoop> loop_;
};

class TroubledLaw : public ForceLaw
{
public:
    explicit TroubledLaw(std::function<void()> trouble) : trouble_(std::move(trouble)) {}

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override
    {
        law_.forces(tool, touches, dt, forces);
        trouble_();
    }

    void reset() override
    {
        law_.reset();
        if (at_reset)
            at_reset();
    }
    Material material() const override { return law_.material(); }

    std::function<void()> at_reset; ///< may be empty

private:
    PenaltyLaw law_{Material{spring, 0, 0}};
    std::function<void()> trouble_;
};
} // namespace ode_predictive_space::haptics

#endif
