// Haptic loops at their rate, by the wall clock: 10,000 objects at 1 kHz, a separate servo at 4 kHz, the ridges of a mesh.

#include "tests/benchmarks/results.h"
#include "tests/benchmarks/ridge_measurement.h"
#include "tests/benchmarks/servo_measurement.h"

namespace
{
using namespace ode_predictive_space;
using namespace ode_predictive_space::benchmarks;
using namespace ode_predictive_space::worlds;

constexpr double fast_rate = 4000; // Hz, for a decoupled servo

/// A space that does not keep up runs many times longer than the time that it simulates.
double seconds_for(SpaceKind kind, double seconds)
{
    return kind == SpaceKind::predictive ? seconds : seconds / 8;
}

nlohmann::json measure(ServoSettings settings)
{
    nlohmann::json records = nlohmann::json::array();
    const double seconds = settings.seconds;
    for (const SpaceKind kind :
         {SpaceKind::predictive, SpaceKind::hash, SpaceKind::quadtree, SpaceKind::sweep_and_prune})
    {
        settings.seconds = seconds_for(kind, seconds);
        records.push_back(servo_record(run_servo(kind, settings), settings));
    }
    return records;
}

nlohmann::json measure_ridges(double seconds)
{
    nlohmann::json records = nlohmann::json::array();
    for (const int cells : {22, 224})
    {
        RidgeSettings settings;
        settings.cells = cells;
        settings.rate = fast_rate;
        settings.seconds = seconds;
        records.push_back(ridge_record(run_ridges(settings), settings));
    }
    return records;
}

void show(const char *title, const nlohmann::json &records, nlohmann::json &all)
{
    std::cout << title << "\n\n";
    print_records(records);
    all.insert(all.end(), records.begin(), records.end());
}

nlohmann::json measure_all(double seconds, int objects)
{
    nlohmann::json all = nlohmann::json::array();
    ServoSettings settings;
    settings.seconds = seconds;
    settings.objects = objects;
    show("Single-threaded at 1,000 Hz", measure(settings), all);
    settings.decoupled = true;
    settings.rate = fast_rate;
    for (const int size : {100, 1000, 10000})
    {
        settings.objects = std::min(size, objects);
        show("The servo in its own thread at 4,000 Hz, the scene at 250 Hz", measure(settings), all);
    }
    show("As before, over the ridges of a mesh, the scene at 100 Hz; error of the force as a share of the force",
         measure_ridges(seconds), all);
    return all;
}
} // namespace

int main(int argc, char **argv)
{
    double seconds = 10;
    int objects = 10000;
    const auto add_options = [&](CLI::App &app) {
        app.add_option("--seconds", seconds, "Seconds of each loop")
            ->check(CLI::Range(0.01, 1000.0))
            ->capture_default_str();
        app.add_option("--n", objects, "Largest number of objects")
            ->check(CLI::Range(1, 1000000))
            ->capture_default_str();
    };
    return run_program(argc, argv, "Measures haptic loops that run at their rate, by the wall clock", add_options,
                       [&] { return measure_all(seconds, objects); });
}
