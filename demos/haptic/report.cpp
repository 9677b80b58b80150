#include "demos/haptic/report.h"

#include "demos/haptic/numbers.h"
#include "ode_predictive_space/recording/curves.h"

#include <iomanip>
#include <sstream>

namespace ode_predictive_space::haptics
{
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TimeSummary, count, mean, p50, p99, p999, max)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoopReport, ticks, steps, period, compute, step_compute, rate, real_time_factor,
                                   overruns, dropped_steps, saturated, notices, scheduling)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ForceError, rms, max)
} // namespace ode_predictive_space::haptics

namespace ode_predictive_space::demo
{
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ServoTotals, ticks, ticks_with_force, force_sum, max_force)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EncounterSummary, contacts, predicted, missed, late, mean_warning, mean_early)

namespace
{
using recording::Curve;
using recording::Plot;

constexpr char seconds_label[] = "simulated time (s)";

std::string milliseconds(double seconds)
{
    return fixed(1e3 * seconds, 3);
}

std::string text_of(const haptics::TimeSummary &times)
{
    return "median " + milliseconds(times.p50) + " ms, p99 " + milliseconds(times.p99) + ", p99.9 " +
           milliseconds(times.p999) + ", longest " + milliseconds(times.max);
}

std::string percent(std::uint64_t part, std::uint64_t whole)
{
    return fixed(whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0, 2) + " %";
}

std::ostream &line(std::ostream &out, const char *name)
{
    return out << std::left << std::setw(16) << name;
}

void print_loop(std::ostream &out, const Options &options, const haptics::LoopReport &loop)
{
    line(out, "Loop") << fixed(loop.rate, 0) << " Hz, " << grouped(loop.ticks) << " ticks, " << grouped(loop.steps)
                      << " steps of the scene; ";
    if (options.fast)
    {
        out << "time is simulated, so there are no periods\n";
        return;
    }
    out << "real-time factor " << fixed(loop.real_time_factor, 3) << '\n';
    line(out, "Period") << text_of(loop.period) << '\n';
    line(out, "Computation") << text_of(loop.compute) << "; " << percent(loop.overruns, loop.ticks)
                             << " of the ticks too long, " << grouped(loop.dropped_steps) << " steps dropped\n";
    line(out, "Scheduling") << loop.scheduling << '\n';
}

void print_force(std::ostream &out, const RunResult &result)
{
    const ServoTotals &servo = result.servo;
    if (servo.ticks_with_force > 0)
        line(out, "Force") << "in " << percent(servo.ticks_with_force, servo.ticks) << " of the ticks, "
                           << fixed(servo.force_sum / static_cast<double>(servo.ticks_with_force), 2)
                           << " N on average, " << fixed(servo.max_force, 2) << " N at most; "
                           << grouped(result.loop.saturated) << " ticks beyond what the device can render\n";
    line(out, "Stiffness") << fixed(result.stiffness, 0) << " N/m at the hand, "
                           << fixed(result.stiffness / result.scale, 1) << " N/m in the scene, which is "
                           << fixed(result.scale, 1) << " times as large as the workspace\n";
    if (result.safety_notices > 0)
        line(out, "Safety") << grouped(result.safety_notices) << (result.safety_notices == 1 ? " notice" : " notices")
                            << " that the loop hung or was late; the force was reduced or removed\n";
}

void print_collisions(std::ostream &out, const RunResult &result)
{
    const double steps = static_cast<double>(std::max<std::uint64_t>(result.loop.steps, 1));
    line(out, "Collisions") << text_of(result.scene.collide) << "; "
                            << fixed(static_cast<double>(result.scene.pairs) / steps, 1) << " near pairs per step\n";
    const EncounterSummary encounters = result.encounters.value_or(EncounterSummary());
    if (encounters.contacts > 0)
        line(out, "Prediction") << "of " << encounters.contacts << " first contacts, " << encounters.predicted
                                << " were predicted, " << fixed(1e3 * encounters.mean_warning, 1)
                                << " ms ahead on average, and came " << fixed(1e3 * encounters.mean_early, 1)
                                << " ms after the predicted time of proximity; " << encounters.late
                                << " came before it, " << encounters.missed << " were missed\n";
}

void print_recordings(std::ostream &out, const Options &options, const RunResult &result)
{
    if (!options.record_file.empty())
        line(out, "Recording") << options.record_file << "; " << grouped(result.lost_in_recording)
                               << " ticks were lost\n";
    if (result.replay_error)
        line(out, "Replay") << grouped(result.replayed_ticks) << " ticks: "
                            << (result.replay_error->max == 0
                                    ? "the forces equal the recorded ones to the last bit"
                                    : "the forces differ from the recorded ones by " +
                                          fixed(result.replay_error->rms, 4) + " N (root mean square), " +
                                          fixed(result.replay_error->max, 4) + " N at most")
                            << '\n';
}

std::string text_of(const Options &options, const RunResult &result)
{
    std::ostringstream text;
    text << "Scene " << options.scene << " with " << grouped(static_cast<std::uint64_t>(options.objects))
         << " objects, space " << options.space << ", device " << options.device << ", law " << result.law << ", seed "
         << options.seed << ".\n\n";
    print_loop(text, options, result.loop);
    print_collisions(text, result);
    print_force(text, result);
    print_recordings(text, options, result);
    return text.str();
}

Plot times_plot(const RunResult &result)
{
    return {"Time per step",
            seconds_label,
            "microseconds",
            {recording::means("dSpaceCollide(), mean", result.scene.collide_series, result.step_seconds, 1e6),
             recording::largest("dSpaceCollide(), longest", result.scene.collide_series, result.step_seconds, 1e6),
             recording::means("step of the world, mean", result.scene.advance_series, result.step_seconds, 1e6)},
            true};
}

Plot servo_plot(const char *title, const char *unit, const RunResult &result, const recording::BoundedSeries &series,
                double scale)
{
    return {title,
            seconds_label,
            unit,
            {recording::largest("largest", series, result.servo_seconds, scale),
             recording::means("mean", series, result.servo_seconds, scale)}};
}

Plot contacts_plot(const RunResult &result)
{
    Curve warnings{"lead time: from the listing to the contact", {}, Curve::Style::dots};
    Curve delays{"contact after its predicted time of proximity", {}, Curve::Style::dots};
    Curve surprises{"contact that was not predicted", {}, Curve::Style::dots};
    for (const LoggedContact &contact : result.contacts)
    {
        if (contact.predicted)
        {
            warnings.points.push_back({contact.time, 1e3 * contact.warning});
            delays.points.push_back({contact.time, 1e3 * (contact.time - contact.forecast)});
        }
        else
        {
            surprises.points.push_back({contact.time, 0});
        }
    }
    return {"Predicted and actual contacts", "time of the contact (s)", "milliseconds", {warnings, delays, surprises}};
}
} // namespace

recording::Page page_of(const Options &options, const RunResult &result)
{
    recording::Page page{"A run of the haptic probe", text_of(options, result), {times_plot(result)}};
    page.plots.push_back(servo_plot("Force at the hand", "newtons", result, result.servo.forces, 1));
    if (!options.fast) // simulated time has no periods
        page.plots.push_back(servo_plot("Period of the servo", "milliseconds", result, result.servo.periods, 1e3));
    page.plots.push_back(contacts_plot(result));
    return page;
}

nlohmann::json json_of(const Options &options, const RunResult &result)
{
    nlohmann::json json = {{"program", "predictive_haptic_demo"},
                           {"scene", options.scene},
                           {"space", options.space},
                           {"device", options.device},
                           {"law", result.law},
                           {"n", options.objects},
                           {"seed", options.seed},
                           {"simulated_time", options.fast},
                           {"loop", result.loop},
                           {"collide", result.scene.collide},
                           {"pairs", result.scene.pairs},
                           {"servo", result.servo},
                           {"stiffness", result.stiffness},
                           {"scale", result.scale},
                           {"safety_notices", result.safety_notices}};
    if (result.encounters)
        json["encounters"] = *result.encounters;
    if (result.replay_error)
        json["replay"] = {{"ticks", result.replayed_ticks}, {"force_error", *result.replay_error}};
    return json;
}
} // namespace ode_predictive_space::demo
