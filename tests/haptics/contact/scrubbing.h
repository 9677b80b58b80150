// A hand that scrubs in straight lines over, off and sometimes through a ball as rough as a scan: its ticks keep their budget.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_SCRUBBING_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_SCRUBBING_H

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "tests/haptics/support/mesh_maker.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/scripted_device.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
constexpr double scrubbed_ball = 0.05; // m

class Scrub
{
public:
    explicit Scrub(double size) : size_(size) {}

    Vector3 operator()(double)
    {
        constexpr double step = 0.3e-3; // m; the hand's travel in a tick
        if ((to_ - at_).norm() < 1e-9)
        {
            const Vector3 side = (at_.normalized() + random_.in_cube(0.8)).normalized();
            to_ = (scrubbed_ball + size_ + (random_.one_in(10) ? 0.005 : random_.between(-0.006, 0))) * side;
        }
        const Vector3 way = to_ - at_;
        at_ += way.norm() > step ? Vector3(step / way.norm() * way) : way;
        return at_;
    }

private:
    double size_; ///< m; the probe's radius
    RandomNumbers random_{1};
    Vector3 at_ = Vector3(0, 0, 0.07);
    Vector3 to_ = Vector3(0, 0, 0.05);
};

/// Runs ticks of 1 ms with the proxy law and probes of three sizes. The mesh is prepared first.
inline void expect_budget_kept(int rings, int ticks)
{
    const OdeUse ode;
    const double noise = 0.2 * M_PI * scrubbed_ball / rings; // m; angles do not depend on the resolution
    const OdeMesh mesh(rough_ball(scrubbed_ball, rings, 0.03, noise, 1));
    for (const double size : {0.001, 0.003, 0.01})
    {
        ProbeWorld world;
        mesh.add_to(world.space);
        ScriptedDevice device{Scrub(size)};
        HapticProbe probe(device, world.space, size, with_law(std::make_shared<ProxyLaw>(Material{500})));
        probe.sensor()->prepare_all();
        std::size_t most = 0; // triangles that are visited in a tick
        int pressed = 0;
        for (int tick = 0; tick < ticks; ++tick)
        {
            world.run(probe, 1);
            most = std::max(most, probe.sensor()->tracker()->visited());
            pressed += probe.last_tick().requested.norm() > 0.5 ? 1 : 0;
        }
        EXPECT_LE(most, SphereSlide::most_triangles) << rings << " rings, " << size << " m";
        EXPECT_GT(pressed, ticks / 8) << rings << " rings, " << size << " m";
    }
}
} // namespace ode_predictive_space::haptics

#endif
