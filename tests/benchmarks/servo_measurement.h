// A haptic loop as programs run it, at its rate, by the wall clock: does it keep up?

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_SERVO_MEASUREMENT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_SERVO_MEASUREMENT_H

#include "demos/runs/spaces.h"
#include "ode_predictive_space/haptics/loop.h"

#include <nlohmann/json.hpp>

namespace ode_predictive_space::benchmarks
{
/// A gas with a probe in its middle that a hand moves. Objects are moved between the ticks, as by a program with given paths.
struct ServoSettings
{
    int objects = 10000;
    double moving = 0.1;       ///< share of the objects
    double rate = 1000;        ///< Hz, of the servo
    bool decoupled = false;    ///< the scene is stepped physics_rate times a second, in a separate thread
    double physics_rate = 250; ///< Hz
    double seconds = 5;        ///< length of the run
    std::uint64_t seed = 1;
    haptics::LoopClock *clock = nullptr; ///< null: the machine's
};

struct ServoResult
{
    worlds::SpaceKind space{};
    haptics::LoopReport report;
    haptics::TimeSummary
        collide_and_force; ///< s per scene step: dSpaceCollide() with the probe's contacts and, unless decoupled, the force
    std::uint64_t steps_in_touch = 0; ///< scene steps with a contact of the probe
    std::uint64_t pairs = 0;          ///< reported by the space

    /// Share of the servo's ticks that were done before the next was due.
    double share_in_time() const;
};

ServoResult run_servo(worlds::SpaceKind kind, const ServoSettings &settings);

nlohmann::json servo_record(const ServoResult &result, const ServoSettings &settings);
} // namespace ode_predictive_space::benchmarks

#endif
