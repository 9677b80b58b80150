// How many objects a haptic loop at 1 kHz can have in each space.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_HAPTIC_MEASUREMENT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_HAPTIC_MEASUREMENT_H

#include "demos/runs/statistics.h"
#include "tests/benchmarks/haptic_loop.h"

#include <functional>
#include <nlohmann/json.hpp>

namespace ode_predictive_space::benchmarks
{
struct HapticSettings
{
    HapticTick tick = HapticTick::collide;
    double deadline = 1000;  ///< microseconds: what computes longer is late
    double in_time = 0.999;  ///< share of the ticks that must not be late
    int ticks = 3000;        ///< of one trial
    double precision = 1.05; ///< the answer is off by less than this factor
    int first = 500;         ///< objects to begin with
    int most = 1000000;      ///< objects at most
    std::uint64_t seed = 1;
};

/// One number of objects, tried in one space.
struct HapticTrial
{
    bool kept = false;          ///< enough ticks were in time
    worlds::Statistics times{}; ///< of the ticks, microseconds; when not kept, up to where that was clear
    double force_sum = 0;       ///< N, over the ticks
};

/// Runs so many ticks after a warm-up, or fewer when too many of them have been late.
HapticTrial try_haptic_loop(worlds::SpaceKind kind, int objects, const HapticSettings &settings);

struct HapticResult
{
    worlds::SpaceKind space{};
    int objects = 0;              ///< the most that kept; 0 when not even one did
    HapticTrial at_most{};        ///< the trial with them
    std::vector<int> kept{};      ///< numbers of objects whose trial kept, as tried
    std::vector<double> forces{}; ///< of those trials
};

/// Finds the number by doubling and then by bisection (geometric). A number that fails is tried once more: a disturbance from
/// outside counts against no space.
///
/// @param attempt called before each trial with its number of objects.
HapticResult most_objects(worlds::SpaceKind kind, const HapticSettings &settings,
                          const std::function<void(int)> &attempt = {});

/// Whether the probe felt the same in all spaces, wherever two of them kept with the same number of objects.
bool same_forces(const std::vector<HapticResult> &results);

/// Objects of this space over those of the best of ODE's spaces; 0 when there is none.
double haptic_ratio(const std::vector<HapticResult> &results, const HapticResult &result);

/// One record per space.
nlohmann::json haptic_records(const std::vector<HapticResult> &results, const HapticSettings &settings);
} // namespace ode_predictive_space::benchmarks

#endif
