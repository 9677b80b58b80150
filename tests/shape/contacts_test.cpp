// The shape test misses no contact, whatever happens to the geoms, and dCollide() is seldom called without result.

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <string>
#include <utility>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/ode_test.h"
#include "tests/shape/shape_history.h"
#include "tests/support/effort.h"

namespace ode_predictive_space
{
namespace
{
using ShapeContacts = OdeTest;

dPredictiveSpaceCounters counters_of(dSpaceID space)
{
    dPredictiveSpaceCounters counters;
    dPredictiveSpaceGetCounters(space, &counters, sizeof counters);
    return counters;
}

struct Totals
{
    long overlapping = 0, contacts = 0, calls = 0, ticks = 0;
    long asked = 0, contacts_of_asked = 0, calls_of_asked = 0; // pairs in queries whose boxes overlap
    unsigned long gap_checks = 0, postponed = 0;
    std::map<std::pair<int, int>, long> contacts_of_classes;
};

void ask(ShapeHistory &history, const std::string &where, Totals &totals)
{
    for (dGeomID probe : history.probes())
    {
        const ShapeHistory::Collision found = history.ask(probe);
        const ShapeHistory::Truth truth = history.brute_force(probe);
        ASSERT_EQ(found.repeated, 0) << where;
        // For rays, more contacts than needed may be found.
        ASSERT_TRUE(
            std::includes(found.contacts.begin(), found.contacts.end(), truth.contacts.begin(), truth.contacts.end()))
            << where << ", a probe of class " << dGeomGetClass(probe);
        totals.asked += truth.overlapping;
        totals.contacts_of_asked += static_cast<long>(found.contacts.size());
        totals.calls_of_asked += found.calls;
    }
}

// Some last until budgets of gap tests are overdrawn, and balanced again.
int ticks_of(unsigned history)
{
    return history % 16 == 0 ? 4800 : 600;
}

void run(const ShapeHistory::Setting &setting, int ticks, Totals &totals)
{
    ShapeHistory history(setting);
    for (int tick = 0; tick < ticks; ++tick)
    {
        history.advance();
        const std::string where = "seed " + std::to_string(setting.seed) + ", tick " + std::to_string(tick);
        if (tick % 4 == 0)
            ask(history, where + ", before it", totals);
        const ShapeHistory::Collision found = history.collide();
        if (tick % 4 == 2)
            ask(history, where, totals);
        ASSERT_EQ(found.repeated, 0) << where;
        const ShapeHistory::Truth truth = history.brute_force();
        ASSERT_EQ(found.contacts, truth.contacts) << where;
        for (const auto &[one, other] : truth.contacts)
            ++totals.contacts_of_classes[std::minmax(dGeomGetClass(one), dGeomGetClass(other))];
        totals.overlapping += truth.overlapping;
        if (tick % 16 == 0)
        {
            ASSERT_EQ(dPredictiveSpaceValidate(history.space()), 1) << where;
            totals.postponed += counters_of(history.space()).postponed;
        }
        totals.contacts += static_cast<long>(found.contacts.size());
        totals.calls += found.calls;
        ++totals.ticks;
    }
    totals.gap_checks += counters_of(history.space()).gap_checks;
}

ShapeHistory::Setting history_of(unsigned i)
{
    ShapeHistory::Setting setting;
    setting.seed = i + 1;
    setting.proximity = dPredictiveProximityShape;
    setting.geoms = 10 + static_cast<int>(i % 3) * 15;
    setting.half_room = 1 + i % 4;
    setting.surprises = i % 5 == 0 ? 3 : i % 5 == 1 ? 0.5 : 0.03;
    setting.all_classes = i % 4 != 1;
    setting.deviation = i % 7 < 3 ? 0.5 : 0;
    return setting;
}

// ODE has no colliders for the other pairs of these classes.
bool meet(int one, int other)
{
    const bool convex_on_mesh = one == dConvexClass && other == dTriMeshClass; // see the history
    return !(one == dPlaneClass && other == dPlaneClass) && !convex_on_mesh;
}

TEST_F(ShapeContacts, AreThoseOfASimpleSpaceInAnyHistory)
{
#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
    constexpr long overlapping = 100000000, contacts_of_each = 1000;
#else
    constexpr long overlapping = 500000, contacts_of_each = 10;
#endif
    Totals totals;
    for (unsigned i = 0; totals.overlapping < overlapping && !HasFailure(); ++i)
        run(history_of(i), ticks_of(i), totals);
    std::cout << totals.ticks << " ticks, " << totals.overlapping << " pairs whose boxes overlap, " << totals.contacts
              << " contacts, " << totals.calls << " calls, " << totals.gap_checks << " gap checks, " << totals.postponed
              << " postponed\n";
    EXPECT_GT(totals.contacts, totals.ticks);
    EXPECT_GT(totals.postponed, 0u);
    constexpr std::array classes{dSphereClass, dBoxClass,    dCapsuleClass, dCylinderClass,
                                 dPlaneClass,  dConvexClass, dTriMeshClass};
    for (int one : classes)
        for (int other : classes)
        {
            const long found = totals.contacts_of_classes[std::make_pair(one, other)];
            EXPECT_TRUE(one > other || !meet(one, other) || found > contacts_of_each) << one << " and " << other;
        }
}

void run_on_surfaces(bool ShapeHistory::Setting::*surface)
{
#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
    constexpr long ticks = 10000000;
#else
    constexpr long ticks = of_cases(20000);
#endif
    Totals totals;
    for (unsigned i = 0; totals.ticks < ticks && !testing::Test::HasFailure(); ++i)
    {
        ShapeHistory::Setting setting = history_of(i);
        setting.*surface = true;
        run(setting, ticks_of(i), totals);
    }
    std::cout << totals.ticks << " ticks, " << totals.overlapping << " pairs whose boxes overlap, " << totals.contacts
              << " contacts, " << totals.calls << " calls; asked " << totals.asked << ", " << totals.contacts_of_asked
              << ", " << totals.calls_of_asked << "\n";
    EXPECT_GT(totals.contacts, totals.ticks);
    EXPECT_GT(totals.postponed, 0u);
    EXPECT_LT(totals.calls_of_asked, totals.asked);
}

TEST_F(ShapeContacts, AreThoseOfASimpleSpaceInAnyHistoryWithinARoom)
{
    run_on_surfaces(&ShapeHistory::Setting::with_room);
}

TEST_F(ShapeContacts, AreThoseOfASimpleSpaceInAnyHistoryOnHills)
{
    run_on_surfaces(&ShapeHistory::Setting::with_hills);
}

Totals in_sparse_scene(int proximity)
{
    ShapeHistory::Setting setting;
    setting.seed = 7;
    setting.proximity = proximity;
    setting.geoms = 150;
    setting.half_room = 6;
    setting.surprises = 0;
    setting.interactive = 1;
    setting.all_classes = setting.with_plane = setting.with_cylinders = false;
    Totals totals;
    run(setting, 500, totals);
    return totals;
}

TEST_F(ShapeContacts, TakeFewCallsWhereObjectsTurnAndSeldomTouch)
{
    const Totals boxes = in_sparse_scene(dPredictiveProximityBox), shapes = in_sparse_scene(dPredictiveProximityShape);
    std::cout << "calls " << boxes.calls << " by boxes, " << shapes.calls << " by shapes, " << shapes.gap_checks
              << " gap checks, contacts " << shapes.contacts << "\n";
    EXPECT_EQ(boxes.contacts, shapes.contacts);
    EXPECT_GT(boxes.calls, 2 * boxes.contacts) << "there is something to be gained";
    EXPECT_LT(shapes.calls - shapes.contacts, (boxes.calls - boxes.contacts) / 4);
    EXPECT_LT(shapes.gap_checks, static_cast<unsigned long>(boxes.calls)) << "most pairs need no gap check at a tick";
    EXPECT_EQ(boxes.gap_checks, 0u);
}
} // namespace
} // namespace ode_predictive_space
