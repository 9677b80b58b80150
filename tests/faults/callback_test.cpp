// A program's functions throw through the space: the lock is released, and later results are exact.

#include <functional>

#include "ode_predictive_space/ode/internals.h"
#include "tests/faults/gas.h"

namespace ode_predictive_space
{
namespace
{
struct Call
{
    const char *name;
    int objects;
    std::function<void(Gas &)> before;
    std::function<void(Gas &)> during;
};

std::ostream &operator<<(std::ostream &out, const Call &call)
{
    return out << call.name;
}

void collide_once(Gas &gas)
{
    collide(gas.space());
}

void stay_calm(Gas &gas)
{
    gas.run(20);
    gas.move();
}

void explode(Gas &gas)
{
    gas.run(20);
    gas.explode();
}

const Call calls[] = {
    {"first_tick", 60, [](Gas &) {}, collide_once},
    {"first_tick_of_many", 200, [](Gas &) {}, collide_once},
    {"calm", 60, stay_calm, collide_once},
    {"calm_of_many", 200, stay_calm, collide_once},
    {"explosion", 60, explode, collide_once},
    {"explosion_of_many", 200, explode, collide_once},
    {"filling", 200,
     [](Gas &gas) {
         explode(gas);
         collide_once(gas);
         gas.move();
     },
     collide_once},
    {"sweeping", 200,
     [](Gas &gas) {
         for (int i = 0; i < 6; ++i)
         {
             gas.explode();
             collide_once(gas);
         }
         gas.explode();
     },
     collide_once},
    {"query", 60, stay_calm, [](Gas &gas) { collide2(gas.geom(1), as_geom(gas.space())); }},
    {"query_of_new_objects", 60, [](Gas &) {}, [](Gas &gas) { collide2(gas.geom(1), as_geom(gas.space())); }},
    {"encounters", 60, stay_calm,
     [](Gas &gas) { dPredictiveSpaceGetEncounters(gas.space(), gas.geom(1), nullptr, 0); }},
    {"cleaning", 60, stay_calm, [](Gas &gas) { dSpaceClean(gas.space()); }},
    {"validating", 60, stay_calm, [](Gas &gas) { dPredictiveSpaceValidate(gas.space()); }},
    {"tick_of_a_space_around_it", 60, stay_calm,
     [](Gas &gas) {
         dSpaceID around = dPredictiveSpaceCreate(nullptr);
         dSpaceAdd(around, as_geom(gas.space()));
         dCreateSphere(around, 1);
         try
         {
             collide(around);
         }
         catch (...)
         {
             dSpaceRemove(around, as_geom(gas.space()));
             dSpaceDestroy(around);
             throw;
         }
         dSpaceRemove(around, as_geom(gas.space()));
         dSpaceDestroy(around);
     }},
};

class EveryCall : public OdeTest, public ::testing::WithParamInterface<Call>
{};

// The functions of a user class throw at their first call, then at their second, and so on, until none throws.
TEST_P(EveryCall, TheNextTickIsExactWhicheverCallOfAUserClassThrows)
{
    bool struck = true;
    int faults = 0;
    for (long spared = 0; struck && !HasFailure(); ++spared)
    {
        Gas gas(GetParam().objects, Matter::user);
        GetParam().before(gas);
        {
            UserClass::Fault fault(spared);
            try
            {
                GetParam().during(gas);
            }
            catch (const UserClass::Thrown &)
            {
                ++faults;
            }
            struck = fault.struck();
        }
        EXPECT_EQ(gas.space()->lock_count, 0);
        if (spared % 2)
        {
            gas.add();
            gas.remove(3);
        }
        gas.expect_exact_for(4);
        EXPECT_FALSE(HasFailure()) << "call " << spared;
    }
    EXPECT_GT(faults, 0);
    RecordProperty("faults", faults);
}

struct NearFault
{
    long spared;
    dSpaceID asked_within = nullptr; // the callback queries it, and its inner callback then throws

    struct Thrown
    {};

    static void visit(void *data, dGeomID first, dGeomID)
    {
        NearFault &fault = *static_cast<NearFault *>(data);
        if (fault.asked_within)
            dSpaceCollide2(first, as_geom(std::exchange(fault.asked_within, nullptr)), data, visit);
        if (fault.spared-- == 0)
            throw Thrown();
    }
};

using Ask = std::function<void(Gas &, NearFault &)>;

class EveryProximity : public OdeTest, public ::testing::WithParamInterface<int>
{
protected:
    void throw_at_each_callback(const Ask &ask)
    {
        int faults = 0;
        for (bool thrown = true; thrown && !HasFailure(); faults += thrown)
        {
            thrown = false;
            Gas gas(60, Matter::shapes, GetParam());
            stay_calm(gas);
            NearFault fault{faults};
            try
            {
                ask(gas, fault);
            }
            catch (const NearFault::Thrown &)
            {
                thrown = true;
            }
            EXPECT_EQ(gas.space()->lock_count, 0);
            if (faults % 2)
            {
                gas.add();
                gas.remove(3);
            }
            gas.expect_exact_for(3);
            EXPECT_FALSE(HasFailure()) << "callback " << faults;
        }
        EXPECT_GT(faults, 3);
    }
};

TEST_P(EveryProximity, TheNextTickIsExactWhicheverNearCallbackOfATickThrows)
{
    throw_at_each_callback([](Gas &gas, NearFault &fault) { dSpaceCollide(gas.space(), &fault, NearFault::visit); });
}

TEST_P(EveryProximity, TheNextTickIsExactWhicheverCallbackOfAQueryThrows)
{
    throw_at_each_callback([](Gas &gas, NearFault &fault) {
        for (std::size_t i = 0; i < 20; ++i)
            dSpaceCollide2(gas.geom(i), as_geom(gas.space()), &fault, NearFault::visit);
    });
}

TEST_P(EveryProximity, TheNextTickIsExactWhicheverCallbackWithinACallbackThrows)
{
    throw_at_each_callback([](Gas &gas, NearFault &fault) {
        fault.asked_within = gas.space();
        dSpaceCollide(gas.space(), &fault, NearFault::visit);
    });
}

TEST_P(EveryProximity, AMessageHandlerThatThrowsChangesNothing)
{
    Gas gas(60, Matter::shapes, GetParam());
    stay_calm(gas);
    struct Thrown
    {};
    dMessageFunction *before = dGetMessageHandler();
    dSetMessageHandler([](int, const char *, va_list) { throw Thrown(); });
    dGeomID outside = dCreateSphere(nullptr, 1);
    EXPECT_THROW(dPredictiveSpaceSetProximity(gas.space(), -1), Thrown);
    EXPECT_THROW(dPredictiveSpaceSetShapeMargin(gas.space(), -1), Thrown);
    EXPECT_THROW(dPredictiveSpaceSetHorizon(gas.space(), 0, 0), Thrown);
    EXPECT_THROW(dPredictiveSpaceSetDeviation(gas.space(), 0, -1, 0, 0), Thrown);
    EXPECT_THROW(dPredictiveSpaceSetGeomRole(gas.space(), outside, 0), Thrown);
    EXPECT_THROW(dPredictiveSpaceGeomChanged(gas.space(), outside), Thrown);
    EXPECT_THROW(dPredictiveSpaceGetEncounters(gas.space(), gas.geom(0), nullptr, 1), Thrown);
    EXPECT_THROW(dPredictiveSpaceGetTimeOfProximity(gas.space(), gas.geom(0), outside, nullptr), Thrown);
    dSetMessageHandler(before);
    EXPECT_EQ(gas.space()->lock_count, 0);
    EXPECT_EQ(dPredictiveSpaceGetProximity(gas.space()), GetParam());
    EXPECT_EQ(dPredictiveSpaceValidate(gas.space()), 1);
    dGeomDestroy(outside);
}

INSTANTIATE_TEST_SUITE_P(Faults, EveryCall, ::testing::ValuesIn(calls),
                         [](const auto &call) { return call.param.name; });
INSTANTIATE_TEST_SUITE_P(Faults, EveryProximity,
                         ::testing::Values(dPredictiveProximityBox, dPredictiveProximitySphere,
                                           dPredictiveProximityShape),
                         [](const auto &info) {
                             return std::string(info.param == dPredictiveProximityBox      ? "box"
                                                : info.param == dPredictiveProximitySphere ? "sphere"
                                                                                           : "shape");
                         });
} // namespace
} // namespace ode_predictive_space
