// Contract 9: queries by rays, and by the sphere test, which leaves out pairs but no contact.

#include <algorithm>
#include <cmath>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

// Geoms of every bounded kind, spread over a room. @param away distance of the room from the origin, along x.
std::vector<dGeomID> fill_room(Scenario &scene, int count, dReal away = 0)
{
    std::vector<dGeomID> geoms;
    for (int i = 0; i < count; ++i)
    {
        const GeomKind kind = static_cast<GeomKind>(i % (geom_kind_count - 3));
        dGeomID geom = scene.numbered(create_geom(kind, 0.3 + 0.2 * (i % 3), scene.space()));
        dGeomSetPosition(geom, away + i % 7 - 3.0, i / 7 % 7 - 3.0, i / 49 % 7 - 3.0);
        geoms.push_back(geom);
    }
    return geoms;
}

void aim(dGeomID ray, int number, dReal away = 0)
{
    dGeomRaySetLength(ray, 0.5 * (1 + number % 17));
    dGeomRaySet(ray, away + 0.9 * (number % 9) - 3.5, 0.8 * (number % 10) - 3.5, 0.7 * (number % 11) - 3.5,
                std::sin(1.1 * number), std::sin(1.7 * number), std::cos(2.3 * number));
}

TEST_F(Contract, 09_RaysMeetWhateverTheirBoundingBoxMeets)
{
    expect_as_simple([](Scenario &scene) {
        const std::vector<dGeomID> geoms = fill_room(scene, 300);
        dGeomID ray = scene.numbered(dCreateRay(nullptr, 1));
        for (int number = 0; number < 200; ++number)
        {
            aim(ray, number);
            scene.query(ray, as_geom(scene.space()));
            dGeomID moved = geoms[static_cast<std::size_t>(number) % geoms.size()];
            dGeomSetPosition(moved, number % 5, 0.01 * number, 0);
            if (number % 10 == 0)
                scene.tick();
        }
        dGeomDestroy(ray);
    });
}

// Compares the pairs of a query in both spaces. Those that the sphere test leaves out must not be in contact.
struct LeftOut
{
    std::size_t reported = 0;
    std::size_t left_out = 0;

    void compare(const Pairs &by_boxes, const Pairs &by_spheres, dGeomID probe, const std::vector<dGeomID> &geoms)
    {
        std::size_t kept = 0;
        for (const Pair &pair : by_boxes)
        {
            if (std::find(by_spheres.begin(), by_spheres.end(), pair) != by_spheres.end())
            {
                ++kept;
                continue;
            }
            ++left_out;
            dContactGeom contacts[4];
            dGeomID other = geoms[static_cast<std::size_t>(pair.second)];
            EXPECT_EQ(dCollide(probe, other, 4, contacts, sizeof(dContactGeom)), 0)
                << "a contact with class " << dGeomGetClass(other) << " is lost";
        }
        EXPECT_EQ(kept, by_spheres.size()) << "what a simple space does not report";
        reported += kept;
    }
};

TEST_F(Contract, 09_BySpheresQueriesLoseNoContact)
{
    Scenario by_boxes(SpaceKind::simple), by_spheres(SpaceKind::predictive);
    dPredictiveSpaceSetProximity(by_spheres.space(), dPredictiveProximitySphere);
    const std::vector<dGeomID> geoms = fill_room(by_boxes, 300);
    fill_room(by_spheres, 300);
    dGeomID ray = number_geom(dCreateRay(nullptr, 1), 1000), ball = number_geom(dCreateSphere(nullptr, 0.4), 1001);
    LeftOut rays, balls;
    for (int number = 0; number < 2000; ++number)
    {
        aim(ray, number);
        rays.compare(collide2(ray, as_geom(by_boxes.space())), collide2(ray, as_geom(by_spheres.space())), ray, geoms);
        const dReal *place = dGeomGetPosition(ray);
        dGeomSetPosition(ball, place[0] + 0.3, place[1] - 0.2, place[2]);
        balls.compare(collide2(ball, as_geom(by_boxes.space())), collide2(ball, as_geom(by_spheres.space())), ball,
                      geoms);
    }
    EXPECT_GT(rays.reported, 1000u);
    EXPECT_GT(rays.left_out, rays.reported) << "a ray is followed along its line";
    EXPECT_GT(balls.reported, 1000u);
    EXPECT_GT(balls.left_out, balls.reported / 20);
    dGeomDestroy(ray);
    dGeomDestroy(ball);
}

TEST_F(Contract, 09_BySpheresQueriesFarAwayLoseNoContact)
{
    constexpr dReal away =
        sizeof(dReal) < sizeof(double) ? 500 : 5e6; // in single precision all would be in one place there
    Scenario by_boxes(SpaceKind::simple), by_spheres(SpaceKind::predictive);
    dPredictiveSpaceSetProximity(by_spheres.space(), dPredictiveProximitySphere);
    const std::vector<dGeomID> geoms = fill_room(by_boxes, 300, away), others = fill_room(by_spheres, 300, away);
    for (int tick = 0; tick < 3; ++tick)
    {
        for (dGeomID geom : {geoms[0], others[0]})
            dGeomSetPosition(geom, away, 0.1 * tick, 0);
        by_spheres.tick();
    }
    dGeomID ray = number_geom(dCreateRay(nullptr, 1), 1000);
    LeftOut rays;
    for (int number = 0; number < 2000; ++number)
    {
        aim(ray, number, away);
        rays.compare(collide2(ray, as_geom(by_boxes.space())), collide2(ray, as_geom(by_spheres.space())), ray, geoms);
    }
    EXPECT_GT(rays.reported, 1000u);
    dGeomDestroy(ray);
}

// The space has chosen an origin near its geoms. From there, the start of the ray is farther than boxes and lines are compared.
TEST_F(Contract, 09_BySpheresARayFromTheOtherSideOfTheWorldIsAnswered)
{
    Scenario scene(SpaceKind::predictive);
    dPredictiveSpaceSetProximity(scene.space(), dPredictiveProximitySphere);
    const dReal away = 7e14, distance = 1e10;
    Pairs on_the_line;
    for (int i = 0; i < 40; ++i)
        if (i % 2)
        {
            scene.sphere(1e9, away + i * distance, 0, 0);
            on_the_line.push_back({i, 1000});
        }
        else
            scene.sphere(1e9, away, distance, i * distance);
    for (int tick = 0; tick < 3; ++tick)
    {
        scene.sphere(1e9, away, -distance, tick * distance);
        scene.tick();
    }
    dGeomID ray = number_geom(dCreateRay(nullptr, REAL(1.6e15)), 1000);
    dGeomRaySet(ray, -8e14, 0, 0, 1, 0, 0);
    EXPECT_EQ(unordered(collide2(ray, as_geom(scene.space()))), unordered(on_the_line));
    dGeomDestroy(ray);
}

// Includes contacts in nested spaces.
void count_contacts(void *count, dGeomID first, dGeomID second)
{
    if (dGeomIsSpace(first) || dGeomIsSpace(second))
    {
        dSpaceCollide2(first, second, count, count_contacts);
        return;
    }
    dContactGeom contacts[8];
    *static_cast<int *>(count) += dCollide(first, second, 8, contacts, sizeof(dContactGeom));
}

TEST_F(Contract, 09_BySpheresAHeightfieldInASpaceLosesNoContact)
{
    // ODE makes contacts beside and below the edge of a heightfield, outside the sphere around the heightfield's space.
    Scenario by_boxes(SpaceKind::simple), by_spheres(SpaceKind::predictive);
    dPredictiveSpaceSetProximity(by_spheres.space(), dPredictiveProximitySphere);
    for (dSpaceID space : {by_boxes.space(), by_spheres.space()})
        create_geom(GeomKind::heightfield, 3, dSimpleSpaceCreate(space));
    dGeomID ray = dCreateRay(nullptr, 1), ball = dCreateSphere(nullptr, 1.5);
    int contacts_seen = 0;
    for (int number = 0; number < 4000; ++number)
    {
        aim(ray, number);
        const dReal *place = dGeomGetPosition(ray);
        dGeomSetPosition(ball, place[0], 1.2 * place[1], place[2]);
        for (dGeomID probe : {ray, ball})
        {
            int expected = 0, found = 0;
            dSpaceCollide2(probe, as_geom(by_boxes.space()), &expected, count_contacts);
            dSpaceCollide2(probe, as_geom(by_spheres.space()), &found, count_contacts);
            ASSERT_EQ(found, expected) << number << (probe == ray ? " ray" : " ball");
            contacts_seen += found;
        }
    }
    EXPECT_GT(contacts_seen, 100);
    dGeomDestroy(ray);
    dGeomDestroy(ball);
}

TEST_F(Contract, 09_BySpheresARayWithoutAnEndIsAskedByItsBox)
{
    Scenario scene(SpaceKind::predictive);
    dPredictiveSpaceSetProximity(scene.space(), dPredictiveProximitySphere);
    scene.sphere(1, 5, 0, 0);
    dGeomID ray = number_geom(dCreateRay(nullptr, dInfinity), 7);
    dGeomRaySet(ray, 0, 0, 0, 1, 0.01, 0.01);
    EXPECT_EQ(collide2(ray, as_geom(scene.space())), Pairs({{7, 0}}));
    dGeomRaySetLength(ray, 1e30);
    EXPECT_EQ(collide2(ray, as_geom(scene.space())), Pairs({{7, 0}}));
    dGeomRaySetLength(ray, 10);
    EXPECT_EQ(collide2(ray, as_geom(scene.space())), Pairs({{7, 0}}));
    dGeomRaySet(ray, 0, 3, 0, 1, 0, 0);
    EXPECT_EQ(collide2(ray, as_geom(scene.space())), Pairs());
    dGeomDestroy(ray);
}
} // namespace
} // namespace ode_predictive_space
