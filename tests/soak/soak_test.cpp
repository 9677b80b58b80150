// Long runs of each scene, while geoms come, go and change their size: pairs stay right, memory and work stay constant.

#include "tests/soak/churned_scene.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <malloc.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::soak
{
namespace
{

struct Case
{
    const char *scene;
    int objects;
    int ticks;
    int ticks_per_copy = 0; ///< see ChurnedScene
    std::string_view space = "predictive-box";
};

void PrintTo(const Case &one, std::ostream *stream)
{
    *stream << one.scene;
}

std::string name_of(const ::testing::TestParamInfo<Case> &info)
{
    const Case &one = info.param;
    return std::string(one.scene) + "_" + std::to_string(one.objects) +
           (one.space == "predictive-shape" ? "_by_shapes" : "");
}

/// Memory of the process, in bytes.
struct Memory
{
    std::size_t allocated = 0;
    std::size_t resident = 0;
};

Memory memory_now()
{
    const struct mallinfo2 heap = mallinfo2();
    std::ifstream file("/proc/self/statm");
    std::size_t whole = 0, resident_pages = 0;
    file >> whole >> resident_pages;
    return {heap.uordblks + heap.hblkhd, resident_pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE))};
}

struct Work
{
    struct Counter
    {
        const char *name;
        double count;
    };
    std::array<Counter, 6> counters;
};

Work work_of(dSpaceID space)
{
    dPredictiveSpaceStats stats;
    dPredictiveSpaceGetStats(space, &stats);
    dPredictiveSpaceCounters more;
    dPredictiveSpaceGetCounters(space, &more, sizeof more);
    const auto count = [](unsigned long number) { return static_cast<double>(number); };
    return {{{{"moved", count(stats.moved)},
              {"violations", count(stats.violations)},
              {"repredictions", count(stats.repredictions)},
              {"woken", count(stats.woken)},
              {"scans", count(stats.scans)},
              {"gap_checks", count(more.gap_checks)}}}};
}

struct Quarter
{
    Memory most;
    Work begin, end;
    double waiting = 0;    ///< pairs that wait for their time of proximity, summed over the samples
    double unreported = 0; ///< pairs in the near set that were not reported, summed over the samples
};
using Quarters = std::array<Quarter, 4>;

constexpr int samples_per_quarter = 100;

void sample(Quarter &quarter, const ChurnedScene &scene)
{
    const Memory now = memory_now();
    quarter.most.allocated = std::max(quarter.most.allocated, now.allocated);
    quarter.most.resident = std::max(quarter.most.resident, now.resident);
    dPredictiveSpaceStats stats;
    dPredictiveSpaceGetStats(scene.space(), &stats);
    quarter.unreported += static_cast<double>(stats.near_pairs) - static_cast<double>(scene.pairs().size());
    quarter.waiting += static_cast<double>(stats.scheduled);
}

/// All pairs of geoms are compared, so with many geoms this is done more rarely.
int ticks_per_comparison(const Case &one)
{
    return one.objects < 1000 ? 97 : 997;
}

TEST(Stats, CountTheBytesOfTheHeap)
{
    constexpr int ticks = 60, jump = 30;
    const worlds::OdeSession ode;
    for (const int proximity : {dPredictiveProximityBox, dPredictiveProximitySphere, dPredictiveProximityShape})
    {
        std::vector<dGeomID> geoms;
        for (int i = 0; i < 5000; ++i)
        {
            geoms.push_back(dCreateSphere(nullptr, 0.2));
            dGeomSetPosition(geoms.back(), i % 17, i / 17 % 17, i / 289);
        }
        const dGeomID plane = dCreatePlane(nullptr, 0, 0, 1, -1);
        const std::size_t without = memory_now().allocated;
        const worlds::OwnedSpace owned(dPredictiveSpaceCreate(nullptr));
        dPredictiveSpaceSetProximity(owned.get(), proximity);
        dSpaceAdd(owned.get(), plane);
        for (const dGeomID geom : geoms)
            dSpaceAdd(owned.get(), geom);
        for (int tick = 0; tick < ticks; ++tick)
        {
            for (std::size_t i = 0; i < geoms.size(); i += tick == jump ? 1 : 2)
            {
                const dReal *at = dGeomGetPosition(geoms[i]);
                dGeomSetPosition(geoms[i], at[0] + (tick == jump ? 3.0 : 0.01), at[1], at[2] + 0.005);
            }
            dSpaceCollide(owned.get(), nullptr, [](void *, dGeomID, dGeomID) {});
            dPredictiveSpaceStats stats;
            dPredictiveSpaceGetStats(owned.get(), &stats);
            const auto heap = static_cast<double>(memory_now().allocated - without);
            const double ratio = heap / static_cast<double>(stats.bytes);
            // A sanitizer has a heap of its own.
            ASSERT_TRUE(heap == 0 || std::abs(ratio - 1) < 0.02) << proximity << ", tick " << tick << ": " << ratio;
        }
    }
}

class Soak : public ::testing::TestWithParam<Case>
{
protected:
    Quarters run();

private:
    void run_quarter(ChurnedScene &scene, Quarter &quarter, int first_tick);

    const worlds::OdeSession ode_;
};

Quarters Soak::run()
{
    const Case &one = GetParam();
    ChurnedScene scene({one.scene, one.objects}, std::string(one.space), one.ticks_per_copy);
    Quarters quarters;
    for (std::size_t i = 0; i < quarters.size() && !HasFatalFailure(); ++i)
    {
        run_quarter(scene, quarters[i], static_cast<int>(i) * (one.ticks / 4));
    }
    return quarters;
}

void Soak::run_quarter(ChurnedScene &scene, Quarter &quarter, int first_tick)
{
    const int ticks = GetParam().ticks / 4;
    quarter.begin = work_of(scene.space());
    for (int tick = first_tick + 1; tick <= first_tick + ticks; ++tick)
    {
        scene.tick();
        if (tick % ticks_per_comparison(GetParam()) == 0)
        {
            ASSERT_EQ(scene.wrong_pairs(), "") << "tick " << tick;
        }
        if (tick % (ticks / samples_per_quarter) == 0)
        {
            sample(quarter, scene);
        }
    }
    quarter.end = work_of(scene.space());
}

// The near set varies with the motion, and so do the tables, which are as large as the largest need so far.
constexpr double most_growth_of_heap = 1.02;
constexpr std::size_t allowed_heap = 64 * 1024;
constexpr std::size_t allowed_resident = 512 * 1024;

void expect_flat_memory(const Quarters &quarters)
{
    const Memory early = quarters[1].most, late = quarters[3].most;
    EXPECT_LE(static_cast<double>(late.allocated),
              most_growth_of_heap * static_cast<double>(early.allocated) + allowed_heap);
    EXPECT_LE(late.resident, early.resident + allowed_resident);
}

constexpr double most_growth_of_work = 1.1;
constexpr double allowed_events = 200; // rare events are random

void expect_same_work(const char *what, double early, double late)
{
    EXPECT_LE(late, most_growth_of_work * early + allowed_events) << what;
}

void expect_same_work(const Quarters &quarters)
{
    for (std::size_t i = 0; i < quarters[0].begin.counters.size(); ++i)
    {
        const auto done = [i](const Quarter &quarter) {
            return quarter.end.counters[i].count - quarter.begin.counters[i].count;
        };
        expect_same_work(quarters[0].begin.counters[i].name, done(quarters[1]), done(quarters[3]));
    }
    expect_same_work("waiting", quarters[1].waiting, quarters[3].waiting);
    expect_same_work("near, not reported", quarters[1].unreported, quarters[3].unreported);
}

TEST_P(Soak, PairsAreRightAndNothingGrows)
{
    const Quarters quarters = run();
    if (HasFatalFailure())
    {
        return;
    }
    expect_flat_memory(quarters);
    expect_same_work(quarters);
}

#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
constexpr Case cases[] = {
    {"gas", 100, 600000},
    {"game", 100, 600000},
    {"classes", 100, 400000},
    {"classes", 100, 200000, 0, "predictive-shape"},
    {"pile", 100, 200000, 5000},
    {"stack", 100, 200000, 2000},
    {"terrain", 100, 600000},
    {"still", 100, 600000},
    {"mix", 100, 300000},
    {"churn", 100, 400000, 25000},
    {"explosion", 100, 400000, 2000},
    {"teleport", 100, 300000},
    {"query", 100, 200000, 25000},
    {"gas", 1000, 700000},
    {"game", 1000, 600000},
    {"classes", 1000, 200000},
    {"classes", 1000, 200000, 0, "predictive-shape"},
    {"pile", 1000, 20000, 1000},
    {"stack", 1000, 40000, 2000},
    {"terrain", 1000, 750000},
    {"still", 1000, 750000},
    {"mix", 1000, 140000},
    {"churn", 1000, 500000, 25000},
    {"explosion", 1000, 500000, 2000},
    {"teleport", 1000, 200000},
    {"query", 1000, 400000, 25000},
};

constexpr int ticks_of_cases(int least_objects)
{
    int ticks = 0;
    for (const Case &one : cases)
    {
        ticks += one.objects >= least_objects ? one.ticks : 0;
    }
    return ticks;
}
static_assert(ticks_of_cases(1) == 10000000 && ticks_of_cases(1000) == 5000000);
#else
constexpr Case cases[] = {
    {"gas", 100, 40000},
    {"game", 100, 40000},
    {"classes", 100, 20000},
    {"classes", 100, 20000, 0, "predictive-shape"},
    {"pile", 100, 8000, 1000},
    {"stack", 100, 16000, 2000},
    {"terrain", 100, 20000},
    {"still", 100, 40000},
    {"mix", 100, 20000},
    {"churn", 100, 40000, 5000},
    {"explosion", 100, 32000, 2000},
    {"teleport", 100, 20000},
    {"query", 100, 20000, 5000},
    {"gas", 1000, 20000},
    {"still", 1000, 40000},
    {"game", 1000, 8000},
};
#endif

INSTANTIATE_TEST_SUITE_P(Scenes, Soak, ::testing::ValuesIn(cases), name_of);

} // namespace
} // namespace ode_predictive_space::soak
