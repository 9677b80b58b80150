// Bad arguments cause an ODE message that names the call and the argument, and change nothing.

#include <limits>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
constexpr dReal nan_value = std::numeric_limits<dReal>::quiet_NaN();
constexpr dReal infinite = std::numeric_limits<dReal>::infinity();

// All settings of a space and a geom, to see that a refused call leaves them as they were.
std::vector<dReal> settings_of(dSpaceID space, dGeomID geom)
{
    int min_ticks = 0, max_ticks = 0;
    dPredictiveSpaceGetHorizon(space, &min_ticks, &max_ticks);
    std::vector<dReal> settings = {dReal(dPredictiveSpaceGetProximity(space)),
                                   dReal(dPredictiveSpaceGetGeomRole(space, geom)),
                                   dPredictiveSpaceGetShapeMargin(space), dReal(min_ticks), dReal(max_ticks)};
    for (int role : {dPredictiveRoleEnvironment, dPredictiveRoleInteractive})
    {
        dReal a = 0, b = 0, c = 0;
        const int fixed = dPredictiveSpaceGetDeviation(space, role, &a, &b, &c);
        settings.insert(settings.end(), {dReal(fixed), a, b, c});
    }
    return settings;
}

class BadInput : public OdeTest
{
protected:
    BadInput()
    {
        dPredictiveSpaceSetProximity(space, dPredictiveProximitySphere);
        dPredictiveSpaceSetGeomRole(space, geom, dPredictiveRoleInteractive);
        dPredictiveSpaceSetDeviation(space, dPredictiveRoleInteractive, 0.1, 0.2, 0.3);
        dPredictiveSpaceSetHorizon(space, 3, 77);
    }

    ~BadInput() override
    {
        dSpaceDestroy(foreign);
        dSpaceDestroy(space);
    }

    void expect_refused(const std::string &call, const std::string &argument, const std::function<void()> &bad_call)
    {
        const std::vector<dReal> before = settings_of(space, geom);
        const std::string complaint = ode_complaint(bad_call);
        EXPECT_NE(complaint.find(call), std::string::npos) << call << " said: " << complaint;
        EXPECT_NE(complaint.find(argument), std::string::npos) << call << " said: " << complaint;
        EXPECT_EQ(settings_of(space, geom), before) << call << " changed something";
        EXPECT_EQ(collide(space).size(), 1u);
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
    }

    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dGeomID geom = dCreateSphere(space, 1);
    dGeomID other = dCreateSphere(space, 1);
    dSpaceID foreign = dHashSpaceCreate(nullptr);
    dGeomID foreign_geom = dCreateSphere(foreign, 1);
};

TEST_F(BadInput, SpacesThatAreNullOrNotPredictive)
{
    const dSpaceID none = nullptr;
    for (dSpaceID bad : {none, foreign})
    {
        dReal ticks = 0;
        dPredictiveEncounter encounter;
        dPredictiveSpaceStats stats;
        dPredictiveSpaceCounters counters;
        const std::pair<const char *, std::function<void()>> calls[] = {
            {"dPredictiveSpaceSetProximity", [=] { dPredictiveSpaceSetProximity(bad, 0); }},
            {"dPredictiveSpaceGetProximity",
             [=] { EXPECT_EQ(dPredictiveSpaceGetProximity(bad), dPredictiveProximityBox); }},
            {"dPredictiveSpaceSetGeomRole", [=] { dPredictiveSpaceSetGeomRole(bad, geom, 0); }},
            {"dPredictiveSpaceGetGeomRole", [=] { EXPECT_EQ(dPredictiveSpaceGetGeomRole(bad, geom), 0); }},
            {"dPredictiveSpaceSetDeviation", [=] { dPredictiveSpaceSetDeviation(bad, 0, 1, 1, 1); }},
            {"dPredictiveSpaceGetDeviation", [=] { EXPECT_EQ(dPredictiveSpaceGetDeviation(bad, 0, 0, 0, 0), 0); }},
            {"dPredictiveSpacePrepare", [=] { dPredictiveSpacePrepare(bad); }},
            {"dPredictiveSpaceGeomChanged", [=] { dPredictiveSpaceGeomChanged(bad, geom); }},
            {"dPredictiveSpaceSetShapeMargin", [=] { dPredictiveSpaceSetShapeMargin(bad, 1); }},
            {"dPredictiveSpaceGetShapeMargin", [=] { EXPECT_EQ(dPredictiveSpaceGetShapeMargin(bad), 0); }},
            {"dPredictiveSpaceSetHorizon", [=] { dPredictiveSpaceSetHorizon(bad, 1, 2); }},
            {"dPredictiveSpaceGetHorizon", [=] { dPredictiveSpaceGetHorizon(bad, 0, 0); }},
            {"dPredictiveSpaceGetTimeOfProximity",
             [&, bad] { EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(bad, geom, other, &ticks), 0); }},
            {"dPredictiveSpaceGetEncounters",
             [&, bad] { EXPECT_EQ(dPredictiveSpaceGetEncounters(bad, geom, &encounter, 1), 0); }},
            {"dPredictiveSpaceGetStats", [&, bad] { dPredictiveSpaceGetStats(bad, &stats); }},
            {"dPredictiveSpaceGetCounters", [&, bad] { dPredictiveSpaceGetCounters(bad, &counters, sizeof counters); }},
            {"dPredictiveSpaceValidate", [=] { EXPECT_EQ(dPredictiveSpaceValidate(bad), 0); }},
        };
        for (const auto &call : calls)
            expect_refused(call.first, "space", call.second);
    }
    EXPECT_EQ(dSpaceGetNumGeoms(foreign), 1);
    EXPECT_TRUE(collide(foreign).empty());
}

TEST_F(BadInput, GeomsThatAreNullOrElsewhere)
{
    dSpaceID nested = dPredictiveSpaceCreate(space);
    dGeomID inner = dCreateSphere(nested, 1);
    dGeomID homeless = dCreateSphere(nullptr, 1);
    dGeomSetPosition(inner, 50, 0, 0);
    dReal ticks = 0;
    dPredictiveEncounter encounter;
    for (dGeomID bad : {dGeomID(nullptr), foreign_geom, inner, homeless, as_geom(space)})
    {
        expect_refused("dPredictiveSpaceSetGeomRole", "geom", [=] { dPredictiveSpaceSetGeomRole(space, bad, 1); });
        expect_refused("dPredictiveSpaceGetGeomRole", "geom",
                       [=] { EXPECT_EQ(dPredictiveSpaceGetGeomRole(space, bad), 0); });
        expect_refused("dPredictiveSpaceGeomChanged", "geom", [=] { dPredictiveSpaceGeomChanged(space, bad); });
        expect_refused("dPredictiveSpaceGetTimeOfProximity", "first",
                       [&, bad] { EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, bad, geom, &ticks), 0); });
        expect_refused("dPredictiveSpaceGetTimeOfProximity", "second",
                       [&, bad] { EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, geom, bad, &ticks), 0); });
        expect_refused("dPredictiveSpaceGetEncounters", "geom",
                       [&, bad] { dPredictiveSpaceGetEncounters(space, bad, &encounter, 1); });
    }
    dGeomDestroy(homeless);
}

TEST_F(BadInput, Constants)
{
    for (int bad : {-1, 3, 1000, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
        expect_refused("dPredictiveSpaceSetProximity", "proximity", [=] { dPredictiveSpaceSetProximity(space, bad); });
    for (int bad : {-1, 2, 1000, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
    {
        expect_refused("dPredictiveSpaceSetGeomRole", "role", [=] { dPredictiveSpaceSetGeomRole(space, geom, bad); });
        expect_refused("dPredictiveSpaceSetDeviation", "role",
                       [=] { dPredictiveSpaceSetDeviation(space, bad, 1, 1, 1); });
        expect_refused("dPredictiveSpaceGetDeviation", "role",
                       [=] { dPredictiveSpaceGetDeviation(space, bad, nullptr, nullptr, nullptr); });
    }
}

TEST_F(BadInput, DeviationsAndMargins)
{
    for (dReal bad : {dReal(-1), -std::numeric_limits<dReal>::min(), nan_value, infinite, -infinite})
    {
        expect_refused("dPredictiveSpaceSetShapeMargin", "margin", [=] { dPredictiveSpaceSetShapeMargin(space, bad); });
        for (int role : {0, 1})
        {
            expect_refused("dPredictiveSpaceSetDeviation", " a",
                           [=] { dPredictiveSpaceSetDeviation(space, role, bad, 1, 1); });
            expect_refused("dPredictiveSpaceSetDeviation", " b",
                           [=] { dPredictiveSpaceSetDeviation(space, role, 1, bad, 1); });
            expect_refused("dPredictiveSpaceSetDeviation", " c",
                           [=] { dPredictiveSpaceSetDeviation(space, role, 1, 1, bad); });
        }
    }
}

TEST_F(BadInput, Horizons)
{
    expect_refused("dPredictiveSpaceSetHorizon", "min_ticks", [=] { dPredictiveSpaceSetHorizon(space, 0, 10); });
    expect_refused("dPredictiveSpaceSetHorizon", "min_ticks", [=] { dPredictiveSpaceSetHorizon(space, -5, 10); });
    expect_refused("dPredictiveSpaceSetHorizon", "max_ticks", [=] { dPredictiveSpaceSetHorizon(space, 5, 4); });
    expect_refused("dPredictiveSpaceSetHorizon", "max_ticks", [=] { dPredictiveSpaceSetHorizon(space, 5, -4); });
    expect_refused("dPredictiveSpaceSetHorizon", "max_ticks", [=] { dPredictiveSpaceSetHorizon(space, 5, 1000001); });
    dPredictiveSpaceSetHorizon(space, 1, 1000000);
    int most = 0;
    dPredictiveSpaceGetHorizon(space, nullptr, &most);
    EXPECT_EQ(most, 1000000);
}

TEST_F(BadInput, RoomForResults)
{
    dPredictiveEncounter encounter = {foreign_geom, 12345};
    expect_refused("dPredictiveSpaceGetEncounters", "max",
                   [&] { EXPECT_EQ(dPredictiveSpaceGetEncounters(space, geom, &encounter, -1), 0); });
    expect_refused("dPredictiveSpaceGetEncounters", "out",
                   [&] { EXPECT_EQ(dPredictiveSpaceGetEncounters(space, geom, nullptr, 3), 0); });
    expect_refused("dPredictiveSpaceGetStats", "stats", [&] { dPredictiveSpaceGetStats(space, nullptr); });
    expect_refused("dPredictiveSpaceGetCounters", "counters",
                   [&] { dPredictiveSpaceGetCounters(space, nullptr, sizeof(dPredictiveSpaceCounters)); });
    EXPECT_EQ(encounter.geom, foreign_geom);
    EXPECT_EQ(encounter.ticks, 12345);
    // A request for no results is no error, nor is a result that is not requested.
    EXPECT_EQ(dPredictiveSpaceGetEncounters(space, geom, nullptr, 0), 0);
    dPredictiveSpaceGetHorizon(space, nullptr, nullptr);
    dPredictiveSpaceGetDeviation(space, dPredictiveRoleInteractive, nullptr, nullptr, nullptr);
    EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, geom, other, nullptr), 1);
}

TEST_F(BadInput, ResultsAreLeftAloneWhenACallIsRefused)
{
    dReal ticks = 777;
    dReal a = 7, b = 8, c = 9;
    int min_ticks = 5, max_ticks = 6;
    dPredictiveSpaceStats stats;
    stats.ticks = 4321;
    ode_complaint([&] { dPredictiveSpaceGetTimeOfProximity(space, geom, nullptr, &ticks); });
    ode_complaint([&] { dPredictiveSpaceGetDeviation(space, 9, &a, &b, &c); });
    ode_complaint([&] { dPredictiveSpaceGetHorizon(foreign, &min_ticks, &max_ticks); });
    ode_complaint([&] { dPredictiveSpaceGetStats(foreign, &stats); });
    EXPECT_EQ(ticks, 777);
    EXPECT_EQ(a + b + c, 24);
    EXPECT_EQ(min_ticks + max_ticks, 11);
    EXPECT_EQ(stats.ticks, 4321u);
}

TEST_F(BadInput, WhatOdeItselfRefuses)
{
    EXPECT_NE(ode_complaint([=] { dSpaceAdd(space, geom); }), "");
    EXPECT_NE(ode_complaint([=] { dSpaceRemove(space, foreign_geom); }), "");
    EXPECT_NE(ode_complaint([=] { dSpaceCollide(space, nullptr, nullptr); }), "");
    EXPECT_NE(ode_complaint([=] { dPredictiveSpaceCreate(reinterpret_cast<dSpaceID>(geom)); }), "");
    EXPECT_EQ(dSpaceGetNumGeoms(space), 2);
    EXPECT_EQ(dSpaceGetNumGeoms(foreign), 1);
    EXPECT_EQ(collide(space).size(), 1u);
}
} // namespace
} // namespace ode_predictive_space
