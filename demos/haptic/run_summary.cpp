#include "demos/haptic/run_summary.h"

#include "demos/runs/table.h"

#include <iomanip>
#include <ostream>

namespace ode_predictive_space::demo
{
namespace
{
using worlds::fixed;
using worlds::grouped;

std::string milliseconds(double seconds, int digits = 3)
{
    return fixed(1e3 * seconds, digits);
}

std::string percent(double part, double whole)
{
    return fixed(whole > 0 ? 100 * part / whole : 0, 2) + " %";
}

std::ostream &line(std::ostream &out, const char *name)
{
    return out << std::left << std::setw(16) << name;
}

void print_loop(std::ostream &out, const Options &options, const haptics::LoopReport &loop)
{
    line(out, "Loop") << fixed(loop.rate, 0) << " Hz, " << grouped(loop.ticks) << " ticks";
    if (loop.steps != loop.ticks)
        out << ", " << grouped(loop.steps) << " steps of the scene";
    if (options.fast)
    {
        out << "; time is simulated, so there are no periods\n";
        return;
    }
    out << "; real-time factor " << fixed(loop.real_time_factor, 3) << '\n';
    line(out, "Period") << "median " << milliseconds(loop.period.p50) << " ms, p99 " << milliseconds(loop.period.p99)
                        << ", p99.9 " << milliseconds(loop.period.p999) << ", longest " << milliseconds(loop.period.max)
                        << '\n';
    line(out, "Computation") << "median " << milliseconds(loop.compute.p50) << " ms, p99 "
                             << milliseconds(loop.compute.p99) << ", p99.9 " << milliseconds(loop.compute.p999)
                             << ", longest " << milliseconds(loop.compute.max) << "; "
                             << percent(static_cast<double>(loop.overruns), static_cast<double>(loop.ticks))
                             << " of the ticks too long\n";
    if (loop.dropped_steps > 0)
        line(out, "") << grouped(loop.dropped_steps) << " steps of the scene dropped, as it was too late\n";
    line(out, "Scheduling") << loop.scheduling << '\n';
}

void print_collisions(std::ostream &out, const RunResult &result)
{
    const double steps = static_cast<double>(std::max<std::uint64_t>(result.loop.steps, 1));
    line(out, "Collisions") << "dSpaceCollide() mean " << milliseconds(result.collide.mean) << " ms, p99 "
                            << milliseconds(result.collide.p99) << ", longest " << milliseconds(result.collide.max)
                            << "; " << fixed(static_cast<double>(result.pairs) / steps, 1) << " near pairs per step\n";
}

void print_force(std::ostream &out, const RunResult &result)
{
    const ServoTotals &servo = result.servo;
    line(out, "Force");
    if (servo.ticks_with_force == 0)
    {
        out << "none";
    }
    else
    {
        out << "in " << percent(static_cast<double>(servo.ticks_with_force), static_cast<double>(servo.ticks))
            << " of the ticks, " << fixed(servo.force_sum / static_cast<double>(servo.ticks_with_force), 2)
            << " N on average, " << fixed(servo.max_force, 2) << " N at most";
        if (result.loop.saturated > 0)
            out << "; the device could not render all of it in "
                << percent(static_cast<double>(result.loop.saturated), static_cast<double>(servo.ticks));
    }
    out << '\n';
    line(out, "Stiffness") << fixed(result.stiffness, 0) << " N/m at the hand, "
                           << fixed(result.stiffness / result.scale, 1) << " N/m in the scene, which is "
                           << fixed(result.scale, 1) << " times as large as the workspace\n";
}

void print_safety(std::ostream &out, const RunResult &result)
{
    if (result.safety_notices > 0)
        line(out, "Safety") << grouped(result.safety_notices) << (result.safety_notices == 1 ? " notice" : " notices")
                            << " that the loop hung or was late; the force was reduced or removed\n";
}

void print_encounters(std::ostream &out, const RunResult &result)
{
    if (result.space_stats)
        line(out, "Prediction") << result.encounters.text() << '\n';
}

void print_recordings(std::ostream &out, const Options &options, const RunResult &result)
{
    if (!options.record_file.empty())
    {
        line(out, "Recording") << options.record_file;
        if (result.lost_in_recording > 0)
            out << "; " << grouped(result.lost_in_recording) << " ticks were lost";
        out << '\n';
    }
    if (result.replay_error)
    {
        const haptics::ForceError &error = *result.replay_error;
        line(out, "Replay") << grouped(result.replayed_ticks) << " ticks: ";
        if (error.max == 0)
        {
            out << "the forces equal the recorded ones to the last bit\n";
            return;
        }
        out << "the forces differ from the recorded ones by " << fixed(error.rms, 4) << " N (root mean square), "
            << fixed(error.max, 4) << " N at most\n";
    }
}

nlohmann::json json_of(const haptics::TimeSummary &times)
{
    return {{"count", times.count},      {"mean_ms", 1e3 * times.mean}, {"p50_ms", 1e3 * times.p50},
            {"p99_ms", 1e3 * times.p99}, {"p999_ms", 1e3 * times.p999}, {"max_ms", 1e3 * times.max}};
}

nlohmann::json json_of(const haptics::LoopReport &loop)
{
    return {{"ticks", loop.ticks},
            {"steps", loop.steps},
            {"rate_hz", loop.rate},
            {"real_time_factor", loop.real_time_factor},
            {"period", json_of(loop.period)},
            {"compute", json_of(loop.compute)},
            {"step", json_of(loop.step_compute)},
            {"overruns", loop.overruns},
            {"dropped_steps", loop.dropped_steps},
            {"saturated_ticks", loop.saturated},
            {"notices", loop.notices},
            {"scheduling", loop.scheduling}};
}

nlohmann::json json_of_space(const RunResult &result)
{
    nlohmann::json json = {{"collide", json_of(result.collide)}, {"pairs", result.pairs}};
    if (result.space_stats)
    {
        const dPredictiveSpaceStats &stats = *result.space_stats;
        json["repredictions"] = stats.repredictions;
        json["violations"] = stats.violations;
        json["woken"] = stats.woken;
        json["bytes"] = stats.bytes;
        const EncounterSummary &encounters = result.encounters;
        json["encounters"] = {{"contacts", encounters.contacts},
                              {"predicted", encounters.predicted},
                              {"late", encounters.late},
                              {"missed", encounters.missed},
                              {"mean_warning_ms", 1e3 * encounters.mean_warning},
                              {"mean_early_ms", 1e3 * encounters.mean_early}};
    }
    return json;
}
} // namespace

void print_beginning(std::ostream &out, const Options &options, bool window)
{
    out << "Scene " << options.scene << " with " << grouped(static_cast<std::uint64_t>(options.objects))
        << " objects, space " << options.spaces.front() << ", device " << options.device << ", law " << options.law
        << ", seed " << options.seed << ".\n";
    if (window)
        out << "The keys are listed in the window.\n";
    else if (options.seconds > 0)
        out << "Running for " << fixed(options.seconds, 2) << " simulated seconds, without a window.\n";
    out.flush();
}

void print_summary(std::ostream &out, const Options &options, const RunResult &result)
{
    out << '\n';
    print_loop(out, options, result.loop);
    print_collisions(out, result);
    print_force(out, result);
    print_safety(out, result);
    print_encounters(out, result);
    print_recordings(out, options, result);
}

nlohmann::json json_summary(const Options &options, const RunResult &result)
{
    nlohmann::json json = {{"program", "predictive_haptic_demo"},
                           {"scene", options.scene},
                           {"space", options.spaces.front()},
                           {"device", options.device},
                           {"law", options.law},
                           {"n", options.objects},
                           {"seed", options.seed},
                           {"simulated_time", options.fast},
                           {"loop", json_of(result.loop)},
                           {"collision", json_of_space(result)},
                           {"force",
                            {{"ticks", result.servo.ticks},
                             {"ticks_with_force", result.servo.ticks_with_force},
                             {"sum_n", result.servo.force_sum},
                             {"max_n", result.servo.max_force},
                             {"safety_notices", result.safety_notices},
                             {"stiffness_n_per_m", result.stiffness},
                             {"scale", result.scale}}}};
    if (result.replay_error)
    {
        json["replay"] = {
            {"ticks", result.replayed_ticks}, {"rms_n", result.replay_error->rms}, {"max_n", result.replay_error->max}};
    }
    return json;
}
} // namespace ode_predictive_space::demo
