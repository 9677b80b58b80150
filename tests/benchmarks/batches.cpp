#include "tests/benchmarks/batches.h"

#include "demos/runs/world_run.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/replay.h"

#include <algorithm>
#include <array>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr int warm_up_batches = 3;
constexpr double microseconds_per_second = 1e6;

/// A contender's copy of the scene.
class BatchRun
{
public:
    BatchRun(const std::string &name, const WorldFactory &factory)
        : contender_(benchmarks::make_contender(name, factory)), replay_(factory, contender_->space())
    {}

    double seconds(const Motion &motion, NearCallback callback)
    {
        const auto near = callback == NearCallback::collect ? &PairList::collect : &find_contacts;
        contender_->prepare(static_cast<int>(motion.size()));
        const Clock::time_point start = Clock::now();
        for (const std::vector<Move> &moves : motion)
        {
            replay_.make(moves);
            list_.clear();
            dSpaceCollide(contender_->space(), &list_, near);
            contender_->end_tick();
        }
        return seconds_between(start, Clock::now());
    }

private:
    static void find_contacts(void *, dGeomID first, dGeomID second)
    {
        std::array<dContactGeom, 8> contacts;
        dCollide(first, second, static_cast<int>(contacts.size()), contacts.data(), sizeof(dContactGeom));
    }

    std::unique_ptr<Contender> contender_; // before the replay, whose geoms are in its space
    Replay replay_;
    PairList list_;
};

/// The copy that only moves.
class MotionRun
{
public:
    explicit MotionRun(const WorldFactory &factory)
        : space_(make_space(SpaceKind::simple, factory)), replay_(factory, space_.get())
    {}

    double seconds(const Motion &motion)
    {
        const Clock::time_point start = Clock::now();
        for (const std::vector<Move> &moves : motion)
        {
            replay_.make(moves);
        }
        return seconds_between(start, Clock::now());
    }

private:
    OwnedSpace space_; // before the replay, whose geoms are in it
    Replay replay_;
};

/// The median of the bare motion is subtracted: an interruption in one of its batches must not weigh on all contenders.
std::vector<std::vector<double>> per_tick_without(std::vector<double> bare,
                                                  const std::vector<std::vector<double>> &seconds)
{
    bare.erase(bare.begin(), bare.begin() + warm_up_batches);
    const double motion = summarise(bare).median;
    std::vector<std::vector<double>> times;
    for (const std::vector<double> &series : seconds)
    {
        times.emplace_back();
        for (auto batch = series.begin() + warm_up_batches; batch != series.end(); ++batch)
        {
            times.back().push_back(microseconds_per_second * (*batch - motion) / ticks_per_batch);
        }
    }
    return times;
}
} // namespace

bool measured_in_batches(const WorldSpec &spec)
{
    return spec.objects < objects_for_single_ticks && spec.name != "churn";
}

std::vector<std::vector<double>> measure_batches(const WorldFactory &factory,
                                                 const std::vector<std::string> &contenders, int ticks,
                                                 NearCallback callback)
{
    Recorder recorder(factory);
    MotionRun motion_run(factory);
    std::vector<std::unique_ptr<BatchRun>> runs;
    runs.reserve(contenders.size());
    for (const std::string &name : contenders)
    {
        runs.push_back(std::make_unique<BatchRun>(name, factory));
    }
    const int batches = warm_up_batches + std::max(1, ticks / ticks_per_batch);
    std::vector<double> bare;
    std::vector<std::vector<double>> seconds(runs.size());
    for (int batch = 0; batch < batches; ++batch)
    {
        const Motion motion = recorder.record(ticks_per_batch);
        bare.push_back(motion_run.seconds(motion));
        for (std::size_t i = 0; i < runs.size(); ++i)
        {
            // Each time another one begins, right after the recorder has been at work.
            const std::size_t next = (i + static_cast<std::size_t>(batch)) % runs.size();
            seconds[next].push_back(runs[next]->seconds(motion, callback));
        }
    }
    return per_tick_without(bare, seconds);
}
} // namespace ode_predictive_space::benchmarks
