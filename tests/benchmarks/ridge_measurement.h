// A servo slides over the ridges of a mesh while the scene is slow: is the force right, and how long does it take?

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_RIDGE_MEASUREMENT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_RIDGE_MEASUREMENT_H

#include "ode_predictive_space/haptics/loop.h"

#include <nlohmann/json.hpp>

namespace ode_predictive_space::benchmarks
{
/// The probe moves in the largest circle that the mesh allows, up to a radius of 15 cm. Cells have the same size in all meshes.
struct RidgeSettings
{
    int cells = 224;                     ///< along x and along y, two triangles each
    double rate = 4000;                  ///< Hz, of the servo
    double physics_rate = 100;           ///< Hz, of the scene
    double speed = 0.5;                  ///< m/s
    double seconds = 5;                  ///< length of the run
    haptics::LoopClock *clock = nullptr; ///< null: the machine's

    int triangles() const { return 2 * cells * cells; }
};

struct RidgeResult
{
    haptics::LoopReport report;
    std::uint64_t compared = 0; ///< servo ticks with the probe pressed in
    double p50_error = 0;       ///< error of the force, relative to the true force
    double p999_error = 0;
    double worst_error = 0;
};

RidgeResult run_ridges(const RidgeSettings &settings);

nlohmann::json ridge_record(const RidgeResult &result, const RidgeSettings &settings);
} // namespace ode_predictive_space::benchmarks

#endif
