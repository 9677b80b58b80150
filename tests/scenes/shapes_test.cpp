#include "demos/runs/spaces.h"
#include "demos/worlds/objects.h"
#include "demos/worlds/world.h"
#include "ode_predictive_space/haptics/device/random.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr Shape all_shapes[] = {Shape::sphere, Shape::box, Shape::capsule, Shape::mesh, Shape::cylinder, Shape::convex};

class ShapesTest : public testing::Test
{
protected:
    ShapesTest()
    {
        ball_.add_ball(object_radius);
        ball_.build(true);
    }
    ~ShapesTest() override { dSpaceDestroy(space_); }

    int contacts_of(dGeomID first, dGeomID second)
    {
        dContactGeom contacts[8];
        return dCollide(first, second, 8, contacts, sizeof(dContactGeom));
    }

    static double half_width(dGeomID geom)
    {
        dReal box[6];
        dGeomGetAABB(geom, box);
        return (box[1] - box[0]) / 2;
    }

    OdeSession ode_;
    dSpaceID space_ = dSimpleSpaceCreate(nullptr);
    TriangleMesh ball_;
};

TEST_F(ShapesTest, FitTheirBoundingSphere)
{
    for (const Shape shape : all_shapes)
    {
        const dGeomID geom = make_shape(space_, shape, &ball_);
        dReal box[6];
        dGeomGetAABB(geom, box);
        double longest = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            EXPECT_LE(box[2 * axis + 1], object_radius * 1.0001);
            EXPECT_GE(box[2 * axis], -object_radius * 1.0001);
            longest = std::max(longest, box[2 * axis + 1]);
        }
        EXPECT_GT(longest, 0.5 * object_radius);
    }
}

TEST_F(ShapesTest, CornersOfTheBoxLieOnItsBoundingSphere)
{
    EXPECT_NEAR(std::sqrt(3.0) * half_side_of_box(), object_radius, 1e-12);
}

TEST_F(ShapesTest, MeshIsClosedAndFacesOutwards)
{
    const dGeomID mesh = make_shape(space_, Shape::mesh, &ball_);
    EXPECT_EQ(dGeomTriMeshGetTriangleCount(mesh), 80);
    // Every ray from outside to the centre meets it once, at a face that looks at the ray's beginning.
    haptics::Random random(1);
    const dGeomID ray = dCreateRay(nullptr, 1);
    for (int i = 0; i < 200; ++i)
    {
        const Vector3 from = random.direction();
        const Vector3 towards = -from;
        dGeomRaySet(ray, from.x(), from.y(), from.z(), towards.x(), towards.y(), towards.z());
        dGeomRaySetBackfaceCull(ray, 1);
        ASSERT_GE(contacts_of(ray, mesh), 1) << "ray " << i;
    }
    dGeomDestroy(ray);
}

TEST_F(ShapesTest, OctahedronIsTouchedAtEachOfItsFaces)
{
    const dGeomID octahedron = make_shape(space_, Shape::convex, &ball_);
    const double ball_radius = 0.01;
    const dGeomID ball = dCreateSphere(space_, ball_radius);
    haptics::Random random(1);
    for (int face = 0; face < 8; ++face)
    {
        const Vector3 normal = Vector3((face & 1) * 2 - 1, (face & 2) - 1, (face & 4) / 2 - 1) / std::sqrt(3.0);
        const Vector3 middle = object_radius / std::sqrt(3.0) * normal;
        for (int i = 0; i < 20; ++i)
        {
            const Vector3 aside = 0.2 * object_radius * random.direction().cross(normal);
            set_position(ball, middle + aside + 0.9 * ball_radius * normal);
            EXPECT_EQ(contacts_of(octahedron, ball), 1) << "face " << face;
            set_position(ball, middle + aside + 1.1 * ball_radius * normal);
            EXPECT_EQ(contacts_of(octahedron, ball), 0) << "face " << face;
        }
    }
}

TEST_F(ShapesTest, TouchOneAnother)
{
    for (const Shape one : all_shapes)
    {
        for (const Shape other : all_shapes)
        {
            const dGeomID first = make_shape(space_, one, &ball_);
            const dGeomID second = make_shape(space_, other, &ball_);
            // Not deep: a mesh is hollow, and what lies inside it touches nothing.
            dGeomSetPosition(second, half_width(first) + half_width(second) - 0.01, 0.001, 0.002);
            EXPECT_GT(contacts_of(first, second), 0)
                << "shapes " << static_cast<int>(one) << " and " << static_cast<int>(other);
            dGeomSetPosition(second, 0.21, 0, 0);
            EXPECT_EQ(contacts_of(first, second), 0);
        }
    }
}

TEST_F(ShapesTest, HaveTheMassOfTheirVolume)
{
    const dMass box = mass_of_shape(Shape::box, 1000);
    EXPECT_NEAR(box.mass, 1000 * std::pow(2 * half_side_of_box(), 3), 1e-9);
    const dMass ball = mass_of_shape(Shape::sphere, 1000);
    EXPECT_NEAR(ball.mass, 1000 * 4.0 / 3.0 * pi * std::pow(object_radius, 3), 1e-9);
    const dMass octahedron = mass_of_shape(Shape::convex, 1000);
    EXPECT_NEAR(octahedron.mass, 1000 * 4.0 / 3.0 * std::pow(object_radius, 3), 1e-9);
}
} // namespace
} // namespace ode_predictive_space::worlds
