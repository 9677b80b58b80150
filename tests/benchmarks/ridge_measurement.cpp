#include "tests/benchmarks/ridge_measurement.h"

#include "demos/runs/contender.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "tests/haptics/support/ridges.h"
#include "tests/haptics/support/scripted_device.h"

#include <algorithm>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
constexpr double ridge_probe_radius = 0.01; // m
constexpr double stiffness = 500;           // N/m
constexpr double pressed_in = 0.003;        // m
constexpr double free_for = 0.1;            // s, at the start
constexpr double going_down_for = 0.2;      // s
constexpr double largest_circle = 0.15;     // m
constexpr double least_force = 0.1;         // N; below this a relative error says little

struct Sample
{
    haptics::Vector3 tool;
    haptics::Vector3 force;
};

class Circle
{
public:
    Circle(const RidgeSettings &settings, double cell)
        : radius_(std::min(largest_circle, 0.5 * settings.cells * cell - 1.2 * ridge_probe_radius)),
          turns_(settings.speed / radius_)
    {}

    haptics::Vector3 operator()(double time) const
    {
        const double down = std::clamp((time - free_for) / going_down_for, 0.0, 1.0);
        const double angle = turns_ * std::max(0.0, time - free_for - going_down_for);
        return {radius_ * std::cos(angle), radius_ * std::sin(angle),
                0.02 + down * (ridge_probe_radius - pressed_in - 0.02)};
    }

private:
    double radius_; ///< m
    double turns_;  ///< rad/s
};

haptics::RenderSettings with_proxy()
{
    haptics::Material properties;
    properties.stiffness = stiffness;
    haptics::RenderSettings settings;
    settings.law = std::make_shared<haptics::ProxyLaw>(properties);
    return settings;
}

double at_share(const std::vector<double> &sorted, double share)
{
    return sorted.empty() ? 0 : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

void compare(const std::vector<Sample> &samples, const haptics::RidgeShape &ridges, RidgeResult &result)
{
    std::vector<double> errors;
    if (samples.empty())
    {
        return;
    }
    haptics::ProxyAboveRidges proxy(ridges, ridge_probe_radius, samples.front().tool.x());
    for (const Sample &sample : samples)
    {
        const haptics::Vector3 truth = stiffness * (proxy.follow(sample.tool) - sample.tool);
        if (truth.norm() > least_force)
        {
            errors.push_back((sample.force - truth).norm() / truth.norm());
        }
    }
    std::sort(errors.begin(), errors.end());
    result.compared = errors.size();
    result.p50_error = at_share(errors, 0.5);
    result.p999_error = at_share(errors, 0.999);
    result.worst_error = at_share(errors, 1);
}
} // namespace

RidgeResult run_ridges(const RidgeSettings &settings)
{
    const haptics::RidgeShape ridges;
    const worlds::OwnedSpace space(dPredictiveSpaceCreate(nullptr));
    const haptics::OdeMesh mesh(haptics::ridge_mesh(ridges, settings.cells, settings.cells));
    mesh.add_to(space.get());
    haptics::ScriptedDevice device(Circle(settings, ridges.cell));
    haptics::HapticProbe probe(device, space.get(), ridge_probe_radius, with_proxy());
    std::vector<Sample> samples;
    samples.reserve(static_cast<std::size_t>(settings.seconds * settings.rate) + 100);
    probe.set_recorder([&](const haptics::RenderedTick &tick) {
        if (samples.size() < samples.capacity())
        {
            samples.push_back({tick.tool.position, tick.requested});
        }
    });
    haptics::LoopSettings loop_settings;
    loop_settings.rate = settings.rate;
    loop_settings.decoupled = true;
    loop_settings.physics_rate = settings.physics_rate;
    loop_settings.duration = settings.seconds;
    loop_settings.clock = settings.clock;
    haptics::HapticLoop loop(probe, loop_settings);
    const auto near = [](void *data, dGeomID first, dGeomID second) {
        static_cast<haptics::HapticProbe *>(data)->touch(first, second);
    };
    RidgeResult result;
    result.report = loop.run({[&] { dSpaceCollide(space.get(), &probe, near); }, [](double) {}});
    compare(samples, ridges, result);
    return result;
}

nlohmann::json ridge_record(const RidgeResult &result, const RidgeSettings &settings)
{
    return {{"table", "servo_ridges"},
            {"triangles", settings.triangles()},
            {"rate_hz", settings.rate},
            {"physics_rate_hz", settings.physics_rate},
            {"speed_m_per_s", settings.speed},
            {"ticks", result.report.ticks},
            {"compared", result.compared},
            {"servo_mean_us", 1e6 * result.report.compute.mean},
            {"servo_p50_us", 1e6 * result.report.compute.p50},
            {"servo_p99_us", 1e6 * result.report.compute.p99},
            {"servo_max_us", 1e6 * result.report.compute.max},
            {"force_error_p50", result.p50_error},
            {"force_error_p999", result.p999_error},
            {"force_error_worst", result.worst_error}};
}
} // namespace ode_predictive_space::benchmarks
