// Programs that set every pose before every collide: an unchanged pose is no move. For spheres, boxes, capsules and cylinders
// the space compares bounding boxes in single precision; notices of other classes always count.

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using UnchangedPose = OdeTest;

unsigned long unchanged(dSpaceID space)
{
    dPredictiveSpaceCounters counters;
    dPredictiveSpaceGetCounters(space, &counters, sizeof counters);
    return counters.unchanged;
}

dPredictiveSpaceStats stats(dSpaceID space)
{
    dPredictiveSpaceStats result;
    dPredictiveSpaceGetStats(space, &result);
    return result;
}

void set_again(dGeomID geom)
{
    const dReal *position = dGeomGetPosition(geom);
    dGeomSetPosition(geom, position[0], position[1], position[2]);
}

constexpr int repetitions_until_known = 40;

class Setting
{
public:
    Setting() : space_(dPredictiveSpaceCreate(nullptr))
    {
        for (const auto &create : {sphere, box, capsule, cylinder})
            for (int i = 0; i < 3; ++i)
                geoms_.push_back(create(space_));
        for (std::size_t i = 0; i < geoms_.size(); ++i)
        {
            dGeomSetPosition(geoms_[i], 0.7 * static_cast<double>(i), 0.1, 0);
            number_geom(geoms_[i], static_cast<int>(i));
        }
    }
    ~Setting() { dSpaceDestroy(space_); }

    dSpaceID space() const { return space_; }
    const std::vector<dGeomID> &geoms() const { return geoms_; }

    Pairs set_all_and_collide()
    {
        for (dGeomID geom : geoms_)
            set_again(geom);
        return collide(space_);
    }

    void make_known()
    {
        EXPECT_EQ(dPredictiveSpaceValidate(space_), 1); // makes a space of few geoms predict
        for (int i = 0; i < repetitions_until_known; ++i)
            set_all_and_collide();
    }

private:
    static dGeomID sphere(dSpaceID space) { return dCreateSphere(space, 0.5); }
    static dGeomID box(dSpaceID space) { return dCreateBox(space, 1, 1, 1); }
    static dGeomID capsule(dSpaceID space) { return dCreateCapsule(space, 0.3, 0.6); }
    static dGeomID cylinder(dSpaceID space) { return dCreateCylinder(space, 0.4, 0.7); }

    dSpaceID space_;
    std::vector<dGeomID> geoms_;
};

TEST_F(UnchangedPose, CountsAsNoMove)
{
    Setting setting;
    setting.make_known();
    const dPredictiveSpaceStats before = stats(setting.space());
    const unsigned long known = unchanged(setting.space());
    for (int tick = 0; tick < 50; ++tick)
        EXPECT_FALSE(setting.set_all_and_collide().empty());
    const dPredictiveSpaceStats after = stats(setting.space());
    // Pairs without moves come to rest now and then, and the next notice of a resting object counts. In single precision, ODE
    // computes the box of a cylinder, and each notice counts.
    const std::size_t cylinders = sizeof(dReal) < sizeof(double) ? 3 : 0, others = setting.geoms().size() - cylinders;
    const unsigned long moved = after.moved - before.moved, rests = 2;
    EXPECT_GE(moved, 50 * cylinders);
    EXPECT_LE(moved, 50 * cylinders + rests * others);
    EXPECT_EQ(after.repredictions, before.repredictions);
    EXPECT_EQ(after.scans, before.scans);
    EXPECT_EQ(moved + unchanged(setting.space()) - known, 50 * setting.geoms().size());
}

void turn(dGeomID geom, dReal x, dReal y, dReal z)
{
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, x, y, z, 0.5);
    dGeomSetRotation(geom, turned);
}

TEST_F(UnchangedPose, EveryRealChangeIsNoticed)
{
    struct Change
    {
        std::function<void(dGeomID)> make;
        bool of_spheres; // also counts for spheres
    };
    const std::vector<Change> changes{
        {[](dGeomID geom) { dGeomSetPosition(geom, 100, std::nextafter(0.1, 1.0), 0); }, true},
        {[](dGeomID geom) { dGeomSetPosition(geom, 100, 50, 0); }, true},
        {[](dGeomID geom) { turn(geom, 1, 2, 3); }, false},
        {[](dGeomID geom) { turn(geom, 1, 0, 0); }, false},
    };
    for (const Change &change : changes)
    {
        Setting setting;
        setting.make_known();
        for (dGeomID geom : setting.geoms())
        {
            const dPredictiveSpaceStats before = stats(setting.space());
            change.make(geom);
            collide(setting.space());
            const bool moves = change.of_spheres || dGeomGetClass(geom) != dSphereClass;
            EXPECT_EQ(stats(setting.space()).moved, before.moved + moves);
            EXPECT_EQ(dPredictiveSpaceValidate(setting.space()), 1);
        }
    }
}

// The bounding boxes in single precision are the same, so the move does not count, but the pairs are those of double precision.
TEST_F(UnchangedPose, AMoveThatSinglePrecisionDoesNotTellIsSeenByThePairs)
{
    if (sizeof(dReal) == sizeof(float))
        return; // no move is below single precision there
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dGeomID one = number_geom(dCreateBox(space, 1, 1, 1), 0), other = number_geom(dCreateBox(space, 1, 1, 1), 1);
    dGeomSetPosition(one, 0, 0, 0);
    dGeomSetPosition(other, 2, 0, 0);
    collide(space);
    dGeomSetPosition(other, 1 + 1e-12, 0, 0);
    EXPECT_TRUE(collide(space).empty());
    const unsigned long moved = stats(space).moved;
    for (int i = 0; i < 200; ++i)
    {
        dGeomSetPosition(other, i % 2 ? 1 + 1e-12 : 1 - 1e-12, 0, 0);
        EXPECT_EQ(collide(space).size(), i % 2 ? 0u : 1u) << i;
    }
    EXPECT_LT(stats(space).moved, moved + 10) << "after rests alone";
    for (int i = 0; i < 200; ++i)
        EXPECT_TRUE(collide(space).empty());
    dGeomSetPosition(other, 1 - 1e-12, 0, 0);
    EXPECT_EQ(collide(space).size(), 1u);
    dSpaceDestroy(space);
}

TEST_F(UnchangedPose, ASizeThatChangesIsNoticed)
{
    Setting setting;
    setting.make_known();
    const std::vector<std::function<void(dGeomID)>> resize{
        [](dGeomID geom) { dGeomSphereSetRadius(geom, 3); },
        [](dGeomID geom) { dGeomBoxSetLengths(geom, 1, 1, 9); },
        [](dGeomID geom) { dGeomCapsuleSetParams(geom, 0.3, 9); },
        [](dGeomID geom) { dGeomCylinderSetParams(geom, 0.4, 9); },
    };
    for (std::size_t i = 0; i < resize.size(); ++i)
    {
        dGeomID geom = setting.geoms()[3 * i];
        dGeomID other = dCreateSphere(setting.space(), 0.1);
        dGeomSetPosition(other, dGeomGetPosition(geom)[0], 0.1, 2.7);
        const std::size_t pairs = collide(setting.space()).size();
        resize[i](geom);
        set_again(geom);
        EXPECT_GT(collide(setting.space()).size(), pairs);
        EXPECT_EQ(dPredictiveSpaceValidate(setting.space()), 1);
    }
}

TEST_F(UnchangedPose, AGeomThatLeavesAndReturns)
{
    Setting setting;
    setting.make_known();
    const Pairs pairs = unordered(setting.set_all_and_collide());
    for (int tick = 0; tick < 20; ++tick)
    {
        dGeomID geom = setting.geoms()[static_cast<std::size_t>(tick) % 6]; // all of these have pairs
        const dReal x = dGeomGetPosition(geom)[0];
        dGeomSetPosition(geom, 100, 0.1, 0);
        if (tick % 2)
        {
            EXPECT_NE(unordered(collide(setting.space())), pairs);
        }
        dGeomSetPosition(geom, x, 0.1, 0);
        EXPECT_EQ(unordered(setting.set_all_and_collide()), pairs);
        EXPECT_EQ(dPredictiveSpaceValidate(setting.space()), 1);
    }
}

TEST_F(UnchangedPose, APositionThatIsNoNumber)
{
    Setting setting;
    setting.make_known();
    const Pairs pairs = unordered(setting.set_all_and_collide());
    dGeomID geom = setting.geoms()[4];
    const dReal x = dGeomGetPosition(geom)[0];
    dGeomSetPosition(geom, std::numeric_limits<dReal>::quiet_NaN(), 0, 0);
    for (int tick = 0; tick < 5; ++tick)
        setting.set_all_and_collide();
    dGeomSetPosition(geom, x, 0.1, 0);
    EXPECT_EQ(unordered(setting.set_all_and_collide()), pairs);
}

void change(dGeomID geom)
{
    const dReal number = dRandReal();
    switch (dRandInt(6))
    {
    case 0:
        if (dGeomGetClass(geom) == dSphereClass)
            dGeomSphereSetRadius(geom, 0.2 + number);
        break;
    case 1:
        if (dGeomGetClass(geom) == dBoxClass)
            dGeomBoxSetLengths(geom, 0.2 + number, 0.8, 0.8);
        break;
    case 2:
        if (dGeomGetBody(geom))
            dGeomSetOffsetPosition(geom, number, 0, 0);
        break;
    case 3:
        if (dGeomGetBody(geom))
            dGeomClearOffset(geom);
        break;
    case 4:
        dGeomSetBody(geom, nullptr);
        break;
    default:
        break;
    }
}

TEST_F(UnchangedPose, PairsAreThoseOfASimpleSpace)
{
    for (unsigned long seed = 1; seed <= 10; ++seed)
        expect_as_simple([seed](Scenario &scene) {
            dRandSetSeed(seed);
            constexpr int count = 40;
            const auto place = [] { return 8 * dRandReal(); };
            std::vector<dGeomID> geoms;
            for (int i = 0; i < count; ++i)
            {
                const dReal x = place(), y = place();
                geoms.push_back(i % 2 ? scene.sphere(0.5, x, y, 0) : scene.box(0.8, x, y, 0));
                if (i % 3 == 0)
                    scene.body(geoms.back(), 0, 0, 0);
            }
            for (int tick = 0; tick < 100; ++tick)
            {
                for (dGeomID geom : geoms)
                {
                    const dReal x = place(), y = place();
                    if (dRandInt(20) == 0)
                        dGeomSetPosition(geom, x, y, 0);
                    else
                        set_again(geom);
                }
                change(geoms[static_cast<std::size_t>(dRandInt(count))]);
                scene.tick();
            }
        });
}
} // namespace
} // namespace ode_predictive_space
