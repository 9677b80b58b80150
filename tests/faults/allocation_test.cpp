// Memory runs out in the middle of an update: the call throws, and later results are exact.

#include <functional>
#include <new>
#include <utility>

#include "tests/faults/allocation_faults.h"
#include "tests/faults/gas.h"

namespace ode_predictive_space
{
namespace
{
using AllocationFaults = OdeTest;

struct Situation
{
    const char *name;
    int objects;
    std::function<void(Gas &)> before;
    std::function<void(Gas &)> during;
    Matter matter = Matter::plain;
    int proximity = dPredictiveProximityBox;
};

void tick(Gas &gas)
{
    collide(gas.space());
}

std::ostream &operator<<(std::ostream &out, const Situation &situation)
{
    return out << situation.name;
}

const Situation situations[] = {
    {"first_tick", 60, [](Gas &) {}, tick},
    {"first_tick_of_many", 300, [](Gas &) {}, tick},
    {"calm", 60,
     [](Gas &gas) {
         gas.run(40);
         gas.move();
     },
     tick},
    {"calm_of_many", 300,
     [](Gas &gas) {
         gas.run(40);
         gas.move();
     },
     tick},
    {"explosion", 60,
     [](Gas &gas) {
         gas.run(40);
         gas.explode();
     },
     tick},
    {"explosion_of_many", 300,
     [](Gas &gas) {
         gas.run(40);
         gas.explode();
     },
     tick},
    {"sweeping", 300,
     [](Gas &gas) {
         gas.run(40);
         for (int i = 0; i < 6; ++i)
         {
             gas.explode();
             tick(gas);
         }
         gas.explode();
     },
     tick},
    {"filling", 300,
     [](Gas &gas) {
         gas.run(40);
         gas.explode();
         tick(gas);
         gas.move();
     },
     tick},
    {"calm_returns", 300,
     [](Gas &gas) {
         gas.run(3);
         gas.move();
     },
     tick},
    {"new_objects", 300,
     [](Gas &gas) {
         gas.run(40);
         for (int i = 0; i < 40; ++i)
             gas.add();
         gas.move();
     },
     tick},
    {"query", 300,
     [](Gas &gas) {
         gas.run(40);
         gas.move();
     },
     [](Gas &gas) { collide2(gas.geom(0), as_geom(gas.space())); }},
    {"collide_within_a_callback", 300, [](Gas &gas) { gas.run(40); },
     [](Gas &gas) {
         Gas *left = &gas; // to be collided
         dSpaceCollide(gas.space(), &left, [](void *data, dGeomID, dGeomID) {
             if (Gas *inner = std::exchange(*static_cast<Gas **>(data), nullptr))
             {
                 dPredictiveSpaceSetHorizon(inner->space(), 500, 5000); // larger envelopes, more near pairs
                 tick(*inner);
             }
         });
     }},
    {"encounters", 300,
     [](Gas &gas) {
         gas.run(3);
         gas.move();
     },
     [](Gas &gas) {
         dPredictiveEncounter met[8];
         dPredictiveSpaceGetEncounters(gas.space(), gas.geom(0), met, 8);
     }},
    {"setting", 60,
     [](Gas &gas) {
         gas.run(40);
         gas.move();
     },
     [](Gas &gas) {
         dPredictiveSpaceSetHorizon(gas.space(), 1, 20);
         tick(gas);
     }},
    {"adding", 100,
     [](Gas &gas) {
         gas.run(40);
         gas.move();
     },
     [](Gas &gas) {
         for (int i = 0; i < 100; ++i)
             gas.add();
     }},
    {"removing", 300,
     [](Gas &gas) {
         gas.run(40);
         gas.move();
     },
     [](Gas &gas) {
         for (int i = 0; i < 100; ++i)
             gas.remove(7);
     }},
    {"removing_most", 1100, [](Gas &gas) { gas.run(4); },
     [](Gas &gas) {
         for (int i = 0; i < 1000; ++i)
             gas.remove(0);
     }},
    {"removing_the_last", 1100,
     [](Gas &gas) {
         gas.run(4);
         gas.expect_exact_answer();
     },
     [](Gas &gas) {
         for (std::size_t i = 1100; i > 200; --i)
             gas.remove(i - 1);
     }},
    {"one_more_than_few", 16, [](Gas &gas) { gas.run(5); },
     [](Gas &gas) {
         gas.add();
         tick(gas);
     }},
    {"few_that_begin_to_be_predicted", 12, [](Gas &gas) { gas.run(5); },
     [](Gas &gas) { dPredictiveSpaceGetEncounters(gas.space(), gas.geom(0), nullptr, 0); }},
    {"adding_between_queries", 100, [](Gas &gas) { gas.expect_exact_answer(); }, [](Gas &gas) { gas.add(); }},
    {"resting", 60,
     [](Gas &gas) {
         for (int i = 0; i < 80; ++i)
             collide(gas.space());
         gas.expect_exact_answer();
     },
     [](Gas &gas) { gas.remove(20); }},
    {"encounters_by_shape", 60,
     [](Gas &gas) {
         gas.run(20);
         gas.explode();
     },
     [](Gas &gas) { dPredictiveSpaceGetEncounters(gas.space(), gas.geom(0), nullptr, 0); }, Matter::shapes,
     dPredictiveProximityShape},
    {"from_shapes_to_boxes", 60,
     [](Gas &gas) {
         dPredictiveSpaceSetProximity(gas.space(), dPredictiveProximityShape);
         for (int i = 0; i < 80; ++i)
             collide(gas.space());
     },
     [](Gas &gas) { dPredictiveSpaceSetProximity(gas.space(), dPredictiveProximityBox); }},
    {"by_sphere", 300,
     [](Gas &gas) {
         gas.run(10);
         gas.move();
     },
     tick, Matter::shapes, dPredictiveProximitySphere},
    {"first_tests_of_shapes", 60, [](Gas &) {}, tick, Matter::shapes, dPredictiveProximityShape},
    {"first_tick_with_predictions_by_shape", 60, [](Gas &) {},
     [](Gas &gas) {
         dPredictiveSpaceGetEncounters(gas.space(), gas.geom(0), nullptr, 0);
         tick(gas);
     },
     Matter::shapes, dPredictiveProximityShape},
    {"tests_shapes", 60,
     [](Gas &gas) {
         gas.run(20);
         gas.move();
     },
     tick, Matter::shapes, dPredictiveProximityShape},
    {"looks_at_shapes_of_many", 300,
     [](Gas &gas) {
         gas.run(20);
         gas.move();
     },
     tick, Matter::shapes, dPredictiveProximityShape},
    {"explosion_by_shape", 300,
     [](Gas &gas) {
         gas.run(20);
         gas.explode();
     },
     tick, Matter::shapes, dPredictiveProximityShape},
    {"the_origin_moves", 60,
     [](Gas &gas) {
         gas.shift(1e7);
         gas.run(1);
         gas.move();
     },
     tick},
    {"the_origin_moves_by_shape", 60,
     [](Gas &gas) {
         gas.shift(1e7);
         gas.run(1);
         gas.move();
     },
     tick, Matter::shapes, dPredictiveProximityShape},
    {"shapes_of_other_data", 60,
     [](Gas &gas) {
         gas.run(20);
         gas.move();
     },
     [](Gas &gas) {
         for (std::size_t i = 0; i < 60; ++i)
             dPredictiveSpaceGeomChanged(gas.space(), gas.geom(i));
         tick(gas);
     },
     Matter::shapes, dPredictiveProximityShape},
    {"from_boxes_to_shapes", 60,
     [](Gas &gas) {
         dPredictiveSpaceSetProximity(gas.space(), dPredictiveProximityBox);
         gas.run(20);
         gas.move();
     },
     [](Gas &gas) {
         dPredictiveSpaceSetProximity(gas.space(), dPredictiveProximityShape);
         dPredictiveSpaceSetShapeMargin(gas.space(), 0.05);
         tick(gas);
     },
     Matter::shapes, dPredictiveProximityShape},
    {"validating", 60,
     [](Gas &gas) {
         gas.run(20);
         gas.move();
     },
     [](Gas &gas) { dPredictiveSpaceValidate(gas.space()); }, Matter::shapes, dPredictiveProximityShape},
    {"cleaning", 60,
     [](Gas &gas) {
         gas.run(20);
         gas.move();
     },
     [](Gas &gas) { dSpaceClean(gas.space()); }},
    {"time_of_proximity", 300, [](Gas &gas) { gas.run(3); },
     [](Gas &gas) { dPredictiveSpaceGetTimeOfProximity(gas.space(), gas.geom(0), gas.geom(1), nullptr); }},
    {"asked_often", 300, [](Gas &) {},
     [](Gas &gas) {
         for (int i = 0; i < 60; ++i)
             collide2(gas.geom(0), as_geom(gas.space()));
     }},
    {"a_space_in_the_space", 60,
     [](Gas &gas) {
         gas.run(20);
         gas.move();
     },
     [](Gas &gas) {
         dSpaceID nested = dPredictiveSpaceCreate(gas.space());
         for (int i = 0; i < 20; ++i)
             dGeomSetPosition(dCreateSphere(nested, 0.1), 100, 0, 0);
         tick(gas);
     }},
};

class EverySituation : public OdeTest, public ::testing::WithParamInterface<Situation>
{};

// The first allocation fails, then the second, and so on, until all succeed. Every other time, objects change before the tick.
TEST_P(EverySituation, TheNextTickIsExactWhicheverAllocationFails)
{
    const Situation &situation = GetParam();
    bool struck = true;
    int faults = 0;
    for (long spared = 0; struck && !HasFailure(); ++spared)
    {
        Gas gas(situation.objects, situation.matter, situation.proximity);
        situation.before(gas);
        {
            AllocationFault fault(spared);
            try
            {
                situation.during(gas);
            }
            catch (const std::bad_alloc &)
            {
                ++faults;
            }
            struck = fault.struck();
        }
        if (spared % 2)
        {
            gas.add();
            gas.remove(3);
            gas.expect_exact_answer();
        }
        gas.expect_exact_for(6);
        EXPECT_FALSE(HasFailure()) << "allocation " << spared;
    }
    RecordProperty("faults", faults);
}

INSTANTIATE_TEST_SUITE_P(Faults, EverySituation, ::testing::ValuesIn(situations),
                         [](const auto &situation) { return situation.param.name; });
} // namespace
} // namespace ode_predictive_space
