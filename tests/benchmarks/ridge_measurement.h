// A servo that slides over the ridges of a mesh while the scene is slow: is the force right, and what does it cost?

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_RIDGE_MEASUREMENT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_RIDGE_MEASUREMENT_H

#include "ode_predictive_space/haptics/loop.h"

#include <nlohmann/json.hpp>

namespace ode_predictive_space::benchmarks
{
/// The probe goes round in a circle that is as large as the mesh allows, up to 15 cm. Its cells have the same size in all
/// meshes.
struct RidgeSettings
{
    int cells = 224;                     ///< of two triangles each, in x and in y
    double rate = 4000;                  ///< Hz; of the servo
    double physics_rate = 100;           ///< Hz; of the scene
    double speed = 0.5;                  ///< m/s
    double seconds = 5;                  ///< to run
    haptics::LoopClock *clock = nullptr; ///< 0: the machine's

    int triangles() const { return 2 * cells * cells; }
};

struct RidgeResult
{
    haptics::LoopReport report;
    std::uint64_t compared = 0; ///< ticks of the servo in which the probe is pressed in
    double p50_error = 0;       ///< of the force, over the true one
    double p999_error = 0;
    double worst_error = 0;
};

/// Runs the loop once.
RidgeResult run_ridges(const RidgeSettings &settings);

nlohmann::json ridge_record(const RidgeResult &result, const RidgeSettings &settings);
} // namespace ode_predictive_space::benchmarks

#endif
