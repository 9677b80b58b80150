// Memory that runs out in the middle of an update: the call throws, and whatever comes next is exact.

#include <functional>
#include <new>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"
#include "tests/faults/allocation_faults.h"

namespace ode_predictive_space
{
namespace
{
using AllocationFaults = OdeTest;

/// A gas of spheres and boxes, moved in the same way in each copy of it.
class Gas
{
public:
    explicit Gas(int count) : space_(dPredictiveSpaceCreate(nullptr))
    {
        bodies_.reserve(2 * static_cast<std::size_t>(count)); // no faults of the test itself
        for (int i = 0; i < count; ++i)
            add();
    }
    ~Gas() { dSpaceDestroy(space_); }
    Gas(const Gas &) = delete;
    Gas &operator=(const Gas &) = delete;

    dSpaceID space() const { return space_; }
    dGeomID geom(std::size_t i) const { return bodies_[i].geom; }

    void add()
    {
        const dReal x = place(), y = place(), z = place();
        dGeomID geom = next_number_ % 2 ? dCreateSphere(space_, 0.4) : dCreateBox(space_, 0.6, 0.6, 0.6);
        dGeomSetPosition(geom, x, y, z);
        number_geom(geom, next_number_++);
        const dReal slow = 0.02;
        bodies_.push_back({geom, {slow * number(), slow * number(), slow * number()}});
    }

    void remove(std::size_t i)
    {
        dGeomDestroy(bodies_[i].geom);
        bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(i));
    }

    void move()
    {
        for (std::size_t i = 0; i < bodies_.size(); i += 2)
        {
            const dReal *position = dGeomGetPosition(bodies_[i].geom), *velocity = bodies_[i].velocity;
            dGeomSetPosition(bodies_[i].geom, position[0] + velocity[0], position[1] + velocity[1],
                             position[2] + velocity[2]);
        }
    }

    /// All velocities change, and some objects jump.
    void explode()
    {
        for (Body &body : bodies_)
            for (dReal &velocity : body.velocity)
                velocity = 0.3 * number();
        move();
        for (std::size_t i = 0; i < bodies_.size(); i += 3)
            dGeomSetPosition(bodies_[i].geom, place(), place(), place());
    }

    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
        {
            move();
            collide(space_);
        }
    }

    void expect_exact_for(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
        {
            const Pairs reported = unordered(collide(space_));
            EXPECT_EQ(reported, overlapping());
            EXPECT_EQ(dPredictiveSpaceValidate(space_), 1);
            if (HasFailure())
                return;
            move();
        }
    }

private:
    struct Body
    {
        dGeomID geom;
        dReal velocity[3];
    };

    static bool HasFailure() { return ::testing::Test::HasFailure(); }

    Pairs overlapping() const
    {
        Pairs pairs;
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            for (std::size_t j = i + 1; j < bodies_.size(); ++j)
            {
                dReal a[6], b[6];
                dGeomGetAABB(bodies_[i].geom, a);
                dGeomGetAABB(bodies_[j].geom, b);
                if (a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] && b[4] <= a[5])
                    pairs.push_back({geom_number(bodies_[i].geom), geom_number(bodies_[j].geom)});
            }
        return unordered(pairs);
    }

    // Uniform in [-1, 1].
    dReal number()
    {
        state_ = state_ * 1664525u + 1013904223u;
        return static_cast<dReal>(state_ >> 8) / (1u << 23) - 1;
    }
    dReal place() { return 4 * number(); }

    dSpaceID space_;
    std::vector<Body> bodies_;
    int next_number_ = 0;
    std::uint32_t state_ = 1;
};

/// What a program was doing when memory ran out.
struct Situation
{
    const char *name;
    int objects;
    std::function<void(Gas &)> before;
    std::function<void(Gas &)> during;
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
};

class EverySituation : public OdeTest, public ::testing::WithParamInterface<Situation>
{};

// The first allocation fails, the second, and so on, until all succeed. Every other time, objects are added and removed before the
// next tick.
TEST_P(EverySituation, TheNextTickIsExactWhicheverAllocationFails)
{
    const Situation &situation = GetParam();
    bool struck = true;
    int faults = 0;
    for (long spared = 0; struck && !HasFailure(); ++spared)
    {
        Gas gas(situation.objects);
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
