#include "demos/haptic/run_page.h"

#include "demos/haptic/comparison_report.h"
#include "demos/haptic/run_summary.h"
#include "demos/runs/table.h"
#include "ode_predictive_space/recording/curves.h"

#include <sstream>

namespace ode_predictive_space::demo
{
namespace
{
using recording::Curve;
using recording::Plot;

constexpr char seconds_label[] = "simulated time (s)";

Plot times_plot(const RunResult &result)
{
    const double step = result.series.step_seconds;
    return {"Time per step",
            seconds_label,
            "microseconds",
            {recording::means("dSpaceCollide(), mean", result.series.collide, step, 1e6),
             recording::largest("dSpaceCollide(), longest", result.series.collide, step, 1e6),
             recording::means("contacts and step of the world, mean", result.series.advance, step, 1e6)},
            true};
}

Plot force_plot(const RunResult &result)
{
    return {"Force at the hand",
            seconds_label,
            "newtons",
            {recording::largest("largest", result.series.force, result.series.servo_seconds, 1),
             recording::means("mean", result.series.force, result.series.servo_seconds, 1)}};
}

Plot period_plot(const RunResult &result)
{
    return {"Period of the servo",
            seconds_label,
            "milliseconds",
            {recording::largest("longest", result.series.period, result.series.servo_seconds, 1e3),
             recording::means("mean", result.series.period, result.series.servo_seconds, 1e3)}};
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

Plot comparison_plot(const char *title, const worlds::WorldRuns &runs, double tick_seconds,
                     const std::vector<double> &(worlds::WorldRun::*times)() const)
{
    Plot plot{title, seconds_label, "microseconds", {}, true};
    for (const auto &run : runs)
    {
        recording::BoundedSeries series{};
        for (const double time : (*run.*times)())
            series.add(time);
        plot.curves.push_back(recording::means(run->name(), series, tick_seconds, 1));
    }
    return plot;
}
} // namespace

recording::Page page_of_run(const Options &options, const RunResult &result)
{
    std::ostringstream text;
    text << "Scene " << options.scene << ", " << worlds::grouped(static_cast<std::uint64_t>(options.objects))
         << " objects, space " << options.spaces.front() << ", device " << options.device << ", law " << options.law
         << ", seed " << options.seed << ".\n";
    print_summary(text, options, result);
    recording::Page page{"A run of the haptic probe", text.str(), {times_plot(result), force_plot(result)}};
    if (!options.fast) // simulated time has no periods
        page.plots.push_back(period_plot(result));
    page.plots.push_back(contacts_plot(result));
    return page;
}

recording::Page page_of_comparison(const worlds::WorldRuns &runs, double tick_seconds)
{
    std::ostringstream text;
    worlds::print_report(text, runs);
    return {"Spaces compared",
            text.str(),
            {comparison_plot("Time per tick in dSpaceCollide()", runs, tick_seconds, &worlds::WorldRun::collide_times),
             comparison_plot("Time per whole tick", runs, tick_seconds, &worlds::WorldRun::tick_times)}};
}
} // namespace ode_predictive_space::demo
