// A haptic loop as programs have it, at its rate, by the wall clock: does it keep up?

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_SERVO_MEASUREMENT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_SERVO_MEASUREMENT_H

#include "demos/runs/spaces.h"
#include "ode_predictive_space/haptics/loop.h"

#include <nlohmann/json.hpp>

namespace ode_predictive_space::benchmarks
{
/// The scene is gas with a probe in its midst that a hand moves. What moves is moved between the ticks, as in a program whose
/// objects follow paths of their own.
struct ServoSettings
{
    int objects = 10000;
    double moving = 0.1;       ///< share of the objects
    double rate = 1000;        ///< Hz; of the servo
    bool decoupled = false;    ///< then the scene is stepped physics_rate times a second, in a thread of its own
    double physics_rate = 250; ///< Hz
    double seconds = 5;        ///< to run
    std::uint64_t seed = 1;
    haptics::LoopClock *clock = nullptr; ///< 0: the machine's
};

struct ServoResult
{
    worlds::SpaceKind space{};
    haptics::LoopReport report;
    haptics::TimeSummary
        collide_and_force; ///< s; of the scene's steps: dSpaceCollide() with the probe's contacts, and, unless
                           ///< decoupled, the force
    std::uint64_t steps_in_touch = 0; ///< of the scene: with a contact of the probe
    std::uint64_t pairs = 0;          ///< that the space reported

    /// Of the ticks of the servo, those that were done when the next was due.
    double share_in_time() const;
};

/// Runs the loop once.
ServoResult run_servo(worlds::SpaceKind kind, const ServoSettings &settings);

nlohmann::json servo_record(const ServoResult &result, const ServoSettings &settings);
} // namespace ode_predictive_space::benchmarks

#endif
