#include "tests/benchmarks/haptic_measurement.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace ode_predictive_space::worlds;

constexpr int haptic_warm_up_ticks = 200;

bool is_odes_own(SpaceKind kind)
{
    return !is_predictive(kind);
}

/// The search for one space.
class Search
{
public:
    Search(SpaceKind kind, const HapticSettings &settings, const std::function<void(int)> &attempt)
        : settings_(settings), attempt_(attempt)
    {
        result_.space = kind;
    }

    HapticResult run()
    {
        int low = settings_.first;
        while (!keeps(low))
        {
            if (low == 1)
            {
                return result_;
            }
            low /= 2;
        }
        const int high = low == settings_.first ? double_until_late(low) : 2 * low;
        bisect(low, high);
        return result_;
    }

private:
    bool keeps(int objects)
    {
        for (int trials = 0; trials < 2; ++trials)
        {
            if (attempt_)
            {
                attempt_(objects);
            }
            const HapticTrial trial = try_haptic_loop(result_.space, objects, settings_);
            if (trial.kept)
            {
                result_.objects = objects;
                result_.at_most = trial;
                result_.kept.push_back(objects);
                result_.forces.push_back(trial.force_sum);
                return true;
            }
        }
        return false;
    }

    /// The smallest doubled number that is late; low becomes half of it.
    int double_until_late(int &low)
    {
        int next = 2 * low;
        while (next <= settings_.most && keeps(next))
        {
            low = next;
            next *= 2;
        }
        return next;
    }

    void bisect(int low, int high)
    {
        while (high <= settings_.most && high > settings_.precision * low && high - low > 1)
        {
            const int middle = std::max(low + 1, static_cast<int>(std::sqrt(double(low) * high)));
            (keeps(middle) ? low : high) = middle;
        }
    }

    HapticSettings settings_;
    std::function<void(int)> attempt_;
    HapticResult result_;
};
} // namespace

HapticTrial try_haptic_loop(SpaceKind kind, int objects, const HapticSettings &settings)
{
    HapticLoop loop(kind, objects, settings.seed, settings.tick);
    for (int tick = 0; tick < haptic_warm_up_ticks; ++tick)
    {
        loop.tick();
    }
    const int late_allowed = static_cast<int>(std::floor((1 - settings.in_time) * settings.ticks + 1e-9));
    int late = 0;
    std::vector<double> times;
    while (static_cast<int>(times.size()) < settings.ticks && late <= late_allowed)
    {
        times.push_back(loop.tick());
        late += times.back() > settings.deadline ? 1 : 0;
    }
    HapticTrial trial;
    trial.kept = late <= late_allowed;
    trial.times = summarise(times);
    trial.force_sum = loop.force_sum();
    return trial;
}

HapticResult most_objects(SpaceKind kind, const HapticSettings &settings, const std::function<void(int)> &attempt)
{
    return Search(kind, settings, attempt).run();
}

bool same_forces(const std::vector<HapticResult> &results)
{
    std::map<int, double> forces;
    for (const HapticResult &result : results)
    {
        for (std::size_t i = 0; i < result.kept.size(); ++i)
        {
            if (forces.emplace(result.kept[i], result.forces[i]).first->second != result.forces[i])
            {
                return false;
            }
        }
    }
    return true;
}

double haptic_ratio(const std::vector<HapticResult> &results, const HapticResult &result)
{
    int best = 0;
    for (const HapticResult &other : results)
    {
        best = is_odes_own(other.space) ? std::max(best, other.objects) : best;
    }
    return best == 0 ? 0 : static_cast<double>(result.objects) / best;
}

nlohmann::json haptic_records(const std::vector<HapticResult> &results, const HapticSettings &settings)
{
    nlohmann::json records = nlohmann::json::array();
    for (const HapticResult &result : results)
    {
        const Statistics &times = result.at_most.times;
        records.push_back({{"scene", "haptic"},
                           {"tick", haptic_tick_name(settings.tick)},
                           {"n", result.objects},
                           {"space", space_name(result.space)},
                           {"seed", settings.seed},
                           {"ticks", settings.ticks},
                           {"deadline_us", settings.deadline},
                           {"mean_us", times.mean},
                           {"median_us", times.median},
                           {"p99_us", times.p99},
                           {"p999_us", times.p999},
                           {"max_us", times.max},
                           {"force_sum_n", result.at_most.force_sum},
                           {"objects_over_best_ode", haptic_ratio(results, result)}});
    }
    return records;
}
} // namespace ode_predictive_space::benchmarks
