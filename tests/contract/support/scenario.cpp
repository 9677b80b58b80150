#include "tests/contract/support/scenario.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>

#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space
{
namespace
{
void record(void *data, dGeomID first, dGeomID second)
{
    static_cast<Pairs *>(data)->push_back({geom_number(first), geom_number(second)});
}
} // namespace

int geom_number(dGeomID geom)
{
    // Numbers are stored plus one, so that a geom without a number (data 0) has -1.
    return static_cast<int>(reinterpret_cast<std::intptr_t>(dGeomGetData(geom))) - 1;
}

dGeomID number_geom(dGeomID geom, int number)
{
    dGeomSetData(geom, reinterpret_cast<void *>(static_cast<std::intptr_t>(number) + 1));
    return geom;
}

Pairs collide(dSpaceID space)
{
    Pairs pairs;
    dSpaceCollide(space, &pairs, record);
    return pairs;
}

Pairs collide2(dGeomID first, dGeomID second)
{
    Pairs pairs;
    dSpaceCollide2(first, second, &pairs, record);
    return pairs;
}

Pairs unordered(Pairs pairs)
{
    for (Pair &pair : pairs)
    {
        if (pair.second < pair.first)
            std::swap(pair.first, pair.second);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

dGeomID as_geom(dSpaceID space)
{
    return reinterpret_cast<dGeomID>(space);
}

dSpaceID as_space(dGeomID geom)
{
    return reinterpret_cast<dSpaceID>(geom);
}

Scenario::Scenario(SpaceKind kind, Asked asked)
    : kind_(kind), asked_(kind == SpaceKind::predictive ? asked : Asked::nothing), world_(dWorldCreate()),
      space_(make_space(nullptr))
{}

Scenario::~Scenario()
{
    // After an abort of ODE the space is still locked; its destruction would abort again and hide the first abort.
    if (std::uncaught_exceptions() > 0)
        return;
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
}

dSpaceID Scenario::make_space(dSpaceID parent) const
{
    return kind_ == SpaceKind::predictive ? dPredictiveSpaceCreate(parent) : dSimpleSpaceCreate(parent);
}

dGeomID Scenario::sphere(dReal radius, dReal x, dReal y, dReal z)
{
    dGeomID geom = numbered(dCreateSphere(space_, radius));
    dGeomSetPosition(geom, x, y, z);
    return geom;
}

dGeomID Scenario::box(dReal side, dReal x, dReal y, dReal z)
{
    dGeomID geom = numbered(dCreateBox(space_, side, side, side));
    dGeomSetPosition(geom, x, y, z);
    return geom;
}

dBodyID Scenario::body(dGeomID geom, dReal vx, dReal vy, dReal vz)
{
    dBodyID body = dBodyCreate(world_);
    dVector3 position;
    dGeomCopyPosition(geom, position);
    dGeomSetBody(geom, body);
    dBodySetPosition(body, position[0], position[1], position[2]);
    dBodySetLinearVel(body, vx, vy, vz);
    return body;
}

void Scenario::add(dSpaceID space, dGeomID geom) const
{
    if (kind_ == SpaceKind::simple)
        dSpaceClean(space);
    dSpaceAdd(space, geom);
}

void Scenario::tick()
{
    if (asked_ == Asked::encounters && dSpaceGetNumGeoms(space_) > 0)
        dPredictiveSpaceGetEncounters(space_, dSpaceGetGeom(space_, 0), nullptr, 0);
    const Pairs pairs = unordered(collide(space_));
    log_.push_back(pairs);
    // A failure may repeat at every tick: one report is enough.
    if (std::adjacent_find(pairs.begin(), pairs.end()) != pairs.end())
        throw std::runtime_error("a pair came twice");
    if (asked_ != Asked::nothing && !dPredictiveSpaceValidate(space_))
        throw std::runtime_error("the invariant does not hold at report " + std::to_string(log_.size() - 1));
}

void Scenario::query(dGeomID first, dGeomID second)
{
    Pairs pairs = collide2(first, second);
    std::sort(pairs.begin(), pairs.end());
    log_.push_back(pairs);
}

void Scenario::step(dReal seconds)
{
    dRandSetSeed(1);
    dWorldQuickStep(world_, seconds);
}

void expect_as_simple(const std::function<void(Scenario &)> &program)
{
    constexpr std::array names{"nothing", "validity", "encounters"};
    Scenario simple(SpaceKind::simple);
    program(simple);
    EXPECT_TRUE(std::any_of(simple.log().begin(), simple.log().end(), [](const Pairs &pairs) {
        return !pairs.empty();
    })) << "the program never reported anything";
    for (Asked asked : {Asked::nothing, Asked::validity, Asked::encounters})
    {
        Scenario predictive(SpaceKind::predictive, asked);
        program(predictive);
        ASSERT_EQ(simple.log().size(), predictive.log().size());
        for (std::size_t i = 0; i < simple.log().size(); ++i)
            ASSERT_EQ(simple.log()[i], predictive.log()[i])
                << "in report " << i << ", asked for " << names[static_cast<std::size_t>(asked)];
    }
}
} // namespace ode_predictive_space
