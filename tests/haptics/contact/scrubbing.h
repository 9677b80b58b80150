// A hand that scrubs in straight lines over, off and sometimes through a ball as rough as a scan, and the cost of its ticks.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_SCRUBBING_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_SCRUBBING_H

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/probe.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "tests/haptics/contact/rough_mesh.h"
#include "tests/haptics/support/scripted_device.h"

#include <algorithm>
#include <ctime>
#include <vector>

namespace ode_predictive_space::haptics
{
constexpr double scrubbed_ball = 0.05; // m

/// A ball of some 4 n^2 triangles. Its noise is in proportion to its cells, so that its angles do not depend on the resolution.
inline MeshShape scanned_ball(int rings)
{
    return rough_ball(scrubbed_ball, rings, 0.03, 0.2 * M_PI * scrubbed_ball / rings, 1);
}

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

struct ScrubbingResult
{
    std::size_t most_triangles = 0; ///< visited in a tick
    int pressed = 0;                ///< ticks with a force above 0.5 N
    std::vector<double> seconds;    ///< of processor time: begin(), collide and render() of each tick, sorted
};

/// s; used by the calling thread.
inline double processor_time()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Runs ticks of 1 ms with the proxy law. All meshes in the space are prepared first. @param size m; the probe's radius.
inline ScrubbingResult scrub(dSpaceID space, double size, int ticks)
{
    ScriptedDevice device{Scrub(size)};
    RenderSettings rendering;
    rendering.law = std::make_shared<ProxyLaw>(Material{500});
    HapticProbe probe(device, space, size, rendering);
    probe.sensor()->prepare_all();
    ScrubbingResult result;
    for (int tick = 0; tick < ticks; ++tick)
    {
        const double begin = processor_time();
        probe.begin(0.001 * tick);
        dSpaceCollide(space, &probe, [](void *data, dGeomID first, dGeomID second) {
            static_cast<HapticProbe *>(data)->touch(first, second);
        });
        probe.render(0.001);
        result.seconds.push_back(processor_time() - begin);
        result.most_triangles = std::max(result.most_triangles, probe.sensor()->tracker()->visited());
        result.pressed += probe.last_tick().requested.norm() > 0.5 ? 1 : 0;
    }
    std::sort(result.seconds.begin(), result.seconds.end());
    return result;
}
} // namespace ode_predictive_space::haptics

#endif
