#include "demos/haptic/comparison_report.h"

#include "demos/runs/result_records.h"
#include "demos/runs/table.h"

#include <algorithm>
#include <cctype>
#include <ostream>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double longest_haptic_tick = 1000; // microseconds: haptics needs 1 kHz

double median_collide_time(const WorldRun &run)
{
    return summarise(run.collide_times()).median;
}

double median_tick_time(const WorldRun &run)
{
    return summarise(run.tick_times()).median;
}

double ticks_per_second(const WorldRun &run)
{
    return 1e6 / summarise(run.tick_times()).mean;
}

double per_tick(std::uint64_t sum, const WorldRun &run)
{
    return static_cast<double>(sum) / static_cast<double>(run.ticks());
}

double share_of_late_ticks(const WorldRun &run)
{
    const auto late = std::count_if(run.tick_times().begin(), run.tick_times().end(),
                                    [](double time) { return time > longest_haptic_tick; });
    return static_cast<double>(late) / static_cast<double>(run.tick_times().size());
}

const WorldRun *predictive_run(const WorldRuns &runs)
{
    const auto found = std::find_if(runs.begin(), runs.end(),
                                    [](const auto &run) { return run->contender().family() == Family::predictive; });
    return found == runs.end() ? nullptr : found->get();
}

/// The fastest of the other spaces, by the median; null without another.
const WorldRun *best_other_run(const WorldRuns &runs)
{
    const WorldRun *best = nullptr;
    for (const auto &run : runs)
    {
        if (run->contender().family() != Family::predictive &&
            (best == nullptr || median_collide_time(*run) < median_collide_time(*best)))
            best = run.get();
    }
    return best;
}

std::string long_name(const WorldRun &run)
{
    return run.name() == space_name(SpaceKind::sweep_and_prune) ? "sweep and prune" : run.name();
}

std::string gain_text(const WorldRun *ours, const WorldRun &other, double (*time)(const WorldRun &))
{
    return ours == nullptr || ours == &other ? "-" : fixed(gain_percent(time(*ours), time(other)), 1) + " %";
}

void print_collision_table(std::ostream &out, const WorldRuns &runs)
{
    out << "\nCollision detection: time in dSpaceCollide(), microseconds per tick\n\n";
    Table table({"space", "mean", "median", "p99", "max", "gain", "pairs per tick"});
    for (const auto &run : runs)
    {
        const Statistics times = summarise(run->collide_times());
        table.add({long_name(*run), fixed(times.mean, 1), fixed(times.median, 1), fixed(times.p99, 1),
                   fixed(times.max, 1), gain_text(predictive_run(runs), *run, &median_collide_time),
                   fixed(per_tick(run->pairs(), *run), 1)});
    }
    table.print(out);
}

void print_tick_table(std::ostream &out, const WorldRuns &runs)
{
    out << "\nWhole tick: collision detection, contacts, forces and the step of the world\n\n";
    Table table({"space", "ticks / s", "median (µs)", "over 1 ms", "gain", "contacts / tick"});
    for (const auto &run : runs)
    {
        table.add({long_name(*run), fixed(ticks_per_second(*run), 0), fixed(median_tick_time(*run), 1),
                   fixed(100 * share_of_late_ticks(*run), 1) + " %",
                   gain_text(predictive_run(runs), *run, &median_tick_time),
                   fixed(per_tick(run->contacts(), *run), 2)});
    }
    table.print(out);
}

void print_verdict(std::ostream &out, const WorldRuns &runs)
{
    const WorldRun *ours = predictive_run(runs);
    const WorldRun *best = best_other_run(runs);
    if (ours == nullptr || best == nullptr)
        return;
    const double ratio = median_collide_time(*best) / median_collide_time(*ours);
    out << "The gain is the share of the other space's time that " << ours->name()
        << " saves, by the medians: (T_other - T) / "
           "T_other. A negative gain means that the other space is faster.\n"
        << "By the medians, the predictive space "
        << (ratio >= 1 ? "was " + fixed(ratio, 1) + " times as fast as"
                       : "took " + fixed(1 / ratio, 1) + " times as long as")
        << " the best of the others (" << long_name(*best) << ") in finding the pairs.\n";
}

void print_faster_variants(std::ostream &out, const WorldRuns &runs)
{
    const WorldRun *first = predictive_run(runs);
    for (const auto &run : runs)
    {
        if (run->contender().family() == Family::predictive)
            out << faster_variant_text(run->name(), median_tick_time(*run), first->name(), median_tick_time(*first));
    }
}

void print_probe(std::ostream &out, const WorldRun &run)
{
    const ProbeLog &log = run.probe_log();
    if (log.touched.empty())
    {
        out << "The probe touched nothing.\n";
        return;
    }
    out << "The probe touched " << log.touched.size() << (log.touched.size() == 1 ? " object" : " objects") << ", in "
        << grouped(log.ticks_in_touch) << " of " << grouped(run.ticks()) << " ticks";
    if (log.ticks_in_touch > 0)
        out << "; the force was " << fixed(log.force_sum / static_cast<double>(log.ticks_in_touch), 1)
            << " N on average, " << fixed(log.max_force, 1) << " N at most";
    out << ".\n";
}

void print_false_pairs(std::ostream &out, const WorldRun &run)
{
    if (run.false_pairs() > 0)
        out << "(The " << long_name(run) << " space also reported " << grouped(run.false_pairs())
            << " pairs whose boxes are apart, because it rounds one axis to single precision. They are not counted.)\n";
}

std::vector<const WorldRun *> exact_runs(const WorldRuns &runs)
{
    std::vector<const WorldRun *> exact;
    for (const auto &run : runs)
    {
        if (run->contender().exact())
            exact.push_back(run.get());
    }
    return exact;
}

void print_agreement(std::ostream &out, const WorldRuns &runs)
{
    const std::vector<const WorldRun *> exact = exact_runs(runs);
    const WorldRun &first = exact.empty() ? *runs.front() : *exact.front();
    const int tick = first_difference(runs);
    if (tick >= 0)
    {
        out << "THE SPACES DISAGREE: from tick " << tick << " on, they did not all report the same pairs.\n";
        for (const WorldRun *run : exact)
            out << "  " << long_name(*run) << ": hash of the pairs " << hexadecimal(run->pair_hash()) << '\n';
        return;
    }
    if (exact.size() > 1)
        out << "All " << exact.size() << (exact.size() == runs.size() ? " spaces" : " spaces that compare boxes")
            << " reported the same pairs in each of the " << grouped(first.ticks()) << " ticks: ";
    else
        out << "The space reported ";
    out << grouped(first.pairs()) << " pairs in all (hash " << hexadecimal(first.pair_hash()) << ").\n";
}

void print_contacts_of_inexact(std::ostream &out, const WorldRuns &runs)
{
    const std::vector<const WorldRun *> exact = exact_runs(runs);
    const int tick = first_difference_of_contacts(runs);
    if (tick >= 0)
    {
        out << "THE SPACES DISAGREE: from tick " << tick
            << " on they did not all report the same pairs with contacts.\n";
        return;
    }
    for (const auto &run : runs)
    {
        if (!run->contender().exact() && !exact.empty())
            out << "The " << long_name(*run) << " space left out " << grouped(exact.front()->pairs() - run->pairs())
                << " of them, none of which had contacts.\n";
    }
}
} // namespace

double gain_percent(double ours, double other)
{
    return 100 * (other - ours) / other;
}

std::string faster_variant_text(const std::string &variant, double variant_time, const std::string &first,
                                double first_time)
{
    const std::string measure = variant.substr(variant.find('-') + 1); // of predictive-shape: shape
    if (variant_time >= first_time)
        return "";
    return "By the medians, a whole tick takes " + fixed(gain_percent(variant_time, first_time), 1) +
           " % less time in " + variant + " than in " + first +
           ": there are fewer calls of dCollide(). dPredictiveSpaceSetProximity(space, dPredictiveProximity" +
           static_cast<char>(std::toupper(measure[0])) + measure.substr(1) +
           ") selects it; docs/tuning.md says when it saves time.\n";
}

void print_introduction(std::ostream &out, const WorldSpec &spec, int ticks, std::size_t spaces)
{
    out << grouped(static_cast<std::uint64_t>(spec.objects))
        << " objects in a room: spheres, boxes, capsules and triangle meshes; half of them still, half "
           "floating.\n"
           "A simulated hand moves a haptic probe among them; the probe pushes what it touches.\n"
        << grouped(static_cast<std::uint64_t>(ticks)) << " ticks of 1 ms, stepped by dWorldQuickStep(), seed "
        << spec.seed;
    out << (spaces > 1 ? "; the same motion in each of " + std::to_string(spaces) + " spaces, alternating.\n" : ".\n");
    out.flush();
}

void print_report(std::ostream &out, const WorldRuns &runs)
{
    print_collision_table(out, runs);
    print_tick_table(out, runs);
    out << '\n';
    print_verdict(out, runs);
    print_faster_variants(out, runs);
    print_probe(out, *runs.front());
    print_agreement(out, runs);
    print_contacts_of_inexact(out, runs);
    for (const auto &run : runs)
        print_false_pairs(out, *run);
}

nlohmann::json json_report(const WorldRuns &runs, const WorldSpec &spec)
{
    const WorldRun *ours = predictive_run(runs);
    nlohmann::json records = nlohmann::json::array();
    for (const auto &run : runs)
    {
        nlohmann::json record = record_of(*run, spec);
        record["ticks_per_second"] = ticks_per_second(*run);
        record["whole_tick_median_us"] = median_tick_time(*run);
        record["late_ticks_percent"] = 100 * share_of_late_ticks(*run);
        if (ours != nullptr && ours != run.get())
        {
            record["gain_percent"] = gain_percent(median_collide_time(*ours), median_collide_time(*run));
            record["whole_tick_gain_percent"] = gain_percent(median_tick_time(*ours), median_tick_time(*run));
        }
        records.push_back(record);
    }
    const ProbeLog &probe = runs.front()->probe_log();
    return {{"program", "predictive_haptic_demo"},
            {"same_pairs", first_difference(runs) < 0},
            {"same_contacts", first_difference_of_contacts(runs) < 0},
            {"probe",
             {{"touched", probe.touched.size()},
              {"ticks_in_touch", probe.ticks_in_touch},
              {"force_sum_n", probe.force_sum},
              {"max_force_n", probe.max_force}}},
            {"spaces", records}};
}
} // namespace ode_predictive_space::worlds
