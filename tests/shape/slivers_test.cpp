// A thin box that creeps along slivers under the shape test: no tick's contact is missed.

#include <array>
#include <iostream>
#include <random>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
namespace
{
using Eigen::Vector3d;

// ODE computes the normals of slivers in single precision, so it finds contacts across gaps.
class ShapeSlivers : public OdeTest
{
protected:
    ShapeSlivers() { dPredictiveSpaceSetProximity(space_, dPredictiveProximityShape); }
    ~ShapeSlivers() override { dSpaceDestroy(space_); }

    double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

    Vector3d direction()
    {
        const double x = between(-1, 1), y = between(-1, 1);
        return Vector3d(x, y, between(-1, 1)).normalized();
    }

    Polyhedron slivers()
    {
        constexpr double length = 2, width = 3e-3;
        Polyhedron slivers;
        for (int i = 0; i < 5; ++i)
        {
            const double x = between(0, length), y = between(0, width);
            slivers.corners.emplace_back(x, y, between(-width, width));
        }
        slivers.faces = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {0, 3, 4}};
        return slivers;
    }

    void turn(dGeomID geom, double most)
    {
        const Vector3d axis = direction();
        dMatrix3 turned;
        dRFromAxisAndAngle(turned, static_cast<dReal>(axis[0]), static_cast<dReal>(axis[1]),
                           static_cast<dReal>(axis[2]), static_cast<dReal>(between(0, most)));
        dGeomSetRotation(geom, turned);
    }

    static void put(dGeomID geom, const Vector3d &at)
    {
        dGeomSetPosition(geom, static_cast<dReal>(at[0]), static_cast<dReal>(at[1]), static_cast<dReal>(at[2]));
    }

    static bool touch(dGeomID one, dGeomID other)
    {
        std::array<dContactGeom, 4> contacts;
        return dCollide(one, other, 4, contacts.data(), sizeof contacts[0]) > 0;
    }

    static Vector3d last_contact(dGeomID box, dGeomID mesh, const Vector3d &from, const Vector3d &away)
    {
        double low = 0, high = 0.05;
        for (int i = 0; i < 60; ++i)
        {
            const double middle = 0.5 * (low + high);
            put(box, from + middle * away);
            (touch(box, mesh) ? low : high) = middle;
        }
        return from + low * away;
    }

    Vector3d way_from(dGeomID mesh)
    {
        const dReal *R = dGeomGetRotation(mesh);
        const double side = between(0, 1), tilt = between(0, 1) < 0.5 ? 0.01 : 0.3;
        const Vector3d any = direction();
        if (side < 0.33)
            return any;
        return ((side < 0.66 ? -1 : 1) * Vector3d(R[2], R[6], R[10]) + tilt * any).normalized();
    }

    // The box moves by a nanometre per tick, across the last place with a contact.
    void creep(dGeomID box, dGeomID mesh, const Vector3d &from, const Vector3d &away)
    {
        constexpr double step = 1e-9;
        // The pair is then tested by shape at once, whereas new geoms would be swept.
        dPredictiveSpaceGetEncounters(space_, box, nullptr, 0);
        for (int tick = -30; tick < 30; ++tick)
        {
            put(box, from + step * tick * away);
            const bool reported = collide(space_).size() == 1, touching = touch(box, mesh);
            contacts_ += touching;
            missed_ += touching && !reported;
            left_out_ += !reported;
        }
    }

    void try_pose(unsigned seed)
    {
        random_.seed(seed);
        const MeshArrays arrays(slivers());
        const dGeomID mesh = dCreateTriMesh(space_, arrays.id(), nullptr, nullptr, nullptr);
        turn(mesh, M_PI);
        turn(box_, M_PI);
        const double along = between(0, 2), across = between(0, 3e-3);
        const dReal *R = dGeomGetRotation(mesh);
        const Vector3d from(R[0] * along + R[1] * across, R[4] * along + R[5] * across, R[8] * along + R[9] * across);
        const Vector3d away = way_from(mesh);
        creep(box_, mesh, last_contact(box_, mesh, from, away), away);
        dGeomDestroy(mesh);
    }

    const dSpaceID space_ = dPredictiveSpaceCreate(nullptr);
    const dGeomID box_ = dCreateBox(space_, REAL(2.8e-3), REAL(1.2e-3), REAL(12e-6));
    std::mt19937_64 random_;
    int contacts_ = 0, missed_ = 0, left_out_ = 0;
};

// With the margin for ordinary triangles, 30 of 150,000 poses had contacts without a callback. Half are here, with others.
TEST_F(ShapeSlivers, TouchNoThinBoxWithoutACallbackAtAnyNanometre)
{
    for (unsigned seed : {17526u, 22272u, 25887u, 26856u, 29928u, 31063u, 45786u, 63869u, 67041u, 72783u, 112636u,
                          115174u, 117074u, 135171u, 139724u})
        try_pose(seed);
    constexpr unsigned others = 200;
    for (unsigned seed = 0; seed < others; ++seed)
        try_pose(seed);
    std::cout << contacts_ << " contacts, " << left_out_ << " left out, " << missed_ << " missed\n";
    EXPECT_EQ(missed_, 0);
    EXPECT_GT(contacts_, 0);
    EXPECT_GT(left_out_, 0);
}

// If corners are on one line, divisions by the height of a triangle have no finite result, but must not trap. Triangles of which
// two corners are in one place do not count.
TEST_F(ShapeSlivers, OfNoHeightAreJudgedByTheirBoxesIfTheyHaveThreeCorners)
{
    put(box_, {0.9, 0.9, 0}); // in the bounding box, above no triangle
    for (int i = 0; i < 20; ++i)
        put(dCreateSphere(space_, REAL(0.01)), Vector3d(10, i, 0));
    for (const std::vector<unsigned> &last : {std::vector<unsigned>{0, 1, 4}, {0, 2, 3}, {2, 3, 0}, {2, 0, 3}})
    {
        Polyhedron flat;
        flat.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {2, 0, 0}};
        flat.faces = {{0, 1, 2}, last};
        const MeshArrays arrays(flat);
        const dGeomID mesh = dCreateTriMesh(space_, arrays.id(), nullptr, nullptr, nullptr);
        for (int tick = 0; tick < 3; ++tick)
            EXPECT_EQ(collide(space_).size(), last[2] == 4 ? 1u : 0u) << last[0] << last[1] << last[2];
        dGeomDestroy(mesh);
    }
}
} // namespace
} // namespace ode_predictive_space
