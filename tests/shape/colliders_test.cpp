// ODE's own colliders for shapes that nearly touch: they find no contact of a pair that the shape test leaves out.

#include <array>
#include <cmath>
#include <deque>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/near/shape_test.h"
#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/shape/surface_gap.h"
#include "ode_predictive_space/space/geom_scene.h"
#include "ode_predictive_space/space/geom_shape.h"
#include "tests/contract/support/ode_test.h"
#include "tests/shape/hills_geom.h"
#include "tests/shape/polyhedron_geom.h"
#include "tests/support/effort.h"

namespace ode_predictive_space
{
namespace
{
#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
constexpr bool is_long = true;
#else
constexpr bool is_long = false;
#endif

ConvexShape made_shape(dGeomID geom)
{
    HullStore hulls;
    std::size_t steps = HullMaker::all_steps;
    ConvexShape shape;
    follow_geom(0, geom, hulls, steps, shape);
    return shape;
}

class ShapeColliders : public OdeTest
{
protected:
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    bool one_in(int count) { return random_() % static_cast<unsigned>(count) == 0; }

    dGeomID create(int type, double size)
    {
        const auto side = [&] { return static_cast<dReal>(size * log_between(thinnest_, 1)); };
        switch (type)
        {
        case dSphereClass:
            return dCreateSphere(nullptr, side());
        case dBoxClass:
            return dCreateBox(nullptr, side(), side(), side());
        case dCapsuleClass:
            return dCreateCapsule(nullptr, side(), side());
        case dCylinderClass:
            return dCreateCylinder(nullptr, side(), side());
        case dConvexClass:
            return convexes_.emplace_back(polyhedron(side(), side(), side(), false)).create(nullptr);
        case dTriMeshClass:
            meshes_.emplace_back(polyhedron(side(), side(), side(), true), one_in(2));
            meshes_.back().build_face_angles();
            return dCreateTriMesh(nullptr, meshes_.back().id(), nullptr, nullptr, nullptr);
        default:
        {
            const Vector3 normal = direction();
            return dCreatePlane(nullptr, static_cast<dReal>(normal[0]), static_cast<dReal>(normal[1]),
                                static_cast<dReal>(normal[2]), 0);
        }
        }
    }

    dGeomID create_slivers(double length)
    {
        const double width = length * log_between(1e-4, 1e-2);
        Polyhedron slivers;
        for (int i = 0; i < 5; ++i)
            slivers.corners.emplace_back(between(0, length), between(0, width), between(-width, width));
        slivers.faces = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {0, 3, 4}};
        meshes_.emplace_back(slivers, one_in(2));
        return dCreateTriMesh(nullptr, meshes_.back().id(), nullptr, nullptr, nullptr);
    }

    // Rough ground or a bowl, of many triangles that are up to a hundred times as long as wide.
    dGeomID create_ground(double size)
    {
        const double narrow = log_between(1e-2, 1);
        const bool is_bowl = one_in(2);
        const Polyhedron ground = Polyhedron::sheet(6, 6, [&](double u, double v) {
            const double x = 2 * u - 1, y = 2 * v - 1;
            return Vector3(size * x, size * narrow * y, size * (is_bowl ? x * x + y * y : between(0, 0.2)));
        });
        meshes_.emplace_back(ground, one_in(2));
        return dCreateTriMesh(nullptr, meshes_.back().id(), nullptr, nullptr, nullptr);
    }

    double gap(dGeomID first, dGeomID second)
    {
        const ConvexShape one = made_shape(first), other = made_shape(second);
        for (const ConvexShape *shape : {&one, &other})
            if (shape->surface())
                shape->surface()->build(10000);
        return std::max(find_gap(one, other, Vector3::Zero(), 0).length, surface_gap(one, other, 0).length);
    }

    Vector3 place_on(dGeomID mesh)
    {
        dVector3 corner, second, third;
        const auto triangle = random_() % static_cast<unsigned>(dGeomTriMeshGetTriangleCount(mesh));
        dGeomTriMeshGetTriangle(mesh, static_cast<int>(triangle), &corner, &second, &third);
        const double a = between(0, 1), b = between(0, 1 - a);
        Vector3 place;
        for (Eigen::Index i = 0; i < 3; ++i)
            place[i] = corner[i] + a * (second[i] - corner[i]) + b * (third[i] - corner[i]);
        return place;
    }

    Vector3 place_on(dGeomID heightfield, const Hills &hills, bool is_placeable)
    {
        const Vector3 local = hills.place(random_);
        if (!is_placeable)
            return local;
        dVector3 place;
        dGeomGetRelPointPos(heightfield, static_cast<dReal>(local[0]), static_cast<dReal>(local[1]),
                            static_cast<dReal>(local[2]), place);
        return Vector3(place[0], place[1], place[2]);
    }

    // Moves the geom away from a place on the surface until there is hardly a gap, or contact, then a little farther or back.
    void nearly_touch_surface(dGeomID surface, const Vector3 &place, dGeomID geom, double size)
    {
        const Vector3 towards = direction();
        const bool by_contact = one_in(2);
        double low = 0, high = 4 * size;
        for (int i = 0; i < 50; ++i)
        {
            const double middle = 0.5 * (low + high);
            put(geom, place, towards, middle);
            ((by_contact ? !touch(surface, geom) : gap(surface, geom) > 0) ? high : low) = middle;
        }
        const double on = size * log_between(1e-9, one_in(2) ? 1e-2 : 1);
        put(geom, place, towards, by_contact && one_in(2) ? low : high + (one_in(4) ? -on : on));
    }

    dGeomID create_thin(int type, double length)
    {
        if (type == dTriMeshClass)
            return create_slivers(length * log_between(1e-3, 1));
        const auto side = [&] { return static_cast<dReal>(length * log_between(1e-6, 1e-1)); };
        return type == dBoxClass ? dCreateBox(nullptr, side(), side(), side()) : create(type, side());
    }

    Polyhedron polyhedron(double x, double y, double z, bool may_be_flat)
    {
        const Polyhedron shapes[] = {Polyhedron::cube(), Polyhedron::octahedron(), Polyhedron::tetrahedron(),
                                     Polyhedron::square()};
        const std::size_t choice = random_() % (may_be_flat ? 4 : 3);
        // ODE requires the origin within a convex.
        const double aside = one_in(3) ? may_be_flat ? 1 : 0.05 : 0;
        return shapes[choice].changed(0.5 * Vector3(x, y, z), aside * Vector3(x, y, z).cwiseProduct(direction()));
    }

    Vector3 direction()
    {
        if (one_in(4))
            return Vector3::Unit(static_cast<Eigen::Index>(between(0, 2.999)));
        return Vector3(between(-1, 1), between(-1, 1), between(-1, 1)).normalized();
    }

    void turn(dGeomID geom)
    {
        dMatrix3 turned;
        const double angle = one_in(3) ? log_between(1e-8, 1e-1) : one_in(4) ? std::acos(0.0) : between(-4, 4);
        const Vector3 axis = direction();
        dRFromAxisAndAngle(turned, static_cast<dReal>(axis[0]), static_cast<dReal>(axis[1]),
                           static_cast<dReal>(axis[2]), static_cast<dReal>(angle));
        dGeomSetRotation(geom, turned);
    }

    // The geom's distance is along a direction from `place`; the surface of a plane is put there.
    static void put(dGeomID geom, const Vector3 &place, const Vector3 &direction, double distance)
    {
        const Vector3 at = place + distance * direction;
        if (dGeomGetClass(geom) != dPlaneClass)
        {
            dGeomSetPosition(geom, static_cast<dReal>(at[0]), static_cast<dReal>(at[1]), static_cast<dReal>(at[2]));
            return;
        }
        dVector4 plane;
        dGeomPlaneGetParams(geom, plane);
        const double depth = plane[0] * place[0] + plane[1] * place[1] + plane[2] * place[2] - distance;
        dGeomPlaneSetParams(geom, plane[0], plane[1], plane[2], static_cast<dReal>(depth));
    }

    static bool touch(dGeomID first, dGeomID second)
    {
        dContactGeom found[4];
        return dCollide(first, second, 4, found, sizeof found[0]) > 0;
    }

    void nearly_touch(dGeomID first, dGeomID second, double size)
    {
        const double away = one_in(2) ? 0 : one_in(4) ? 1e4 : 10;
        const Vector3 place = size * away * direction(), towards = direction();
        put(first, place, towards, 0);
        double low = 0, high = 8 * size;
        const bool by_contact = one_in(2);
        const auto apart = [&] {
            return by_contact ? !touch(first, second)
                              : find_gap(made_shape(first), made_shape(second), Vector3::Zero(), 0).length > 0;
        };
        for (int i = 0; i < 40; ++i)
        {
            const double middle = 0.5 * (low + high);
            put(second, place, towards, middle);
            (apart() ? high : low) = middle;
        }
        put(second, place, towards, high + (one_in(4) ? -1 : 1) * size * log_between(1e-9, one_in(2) ? 1e-2 : 1));
    }

    // Moves the second geom away to the last place with a contact: most often from in front or from behind, near an edge.
    void barely_touch(dGeomID mesh, dGeomID second, double size)
    {
        const dReal *R = dGeomGetRotation(mesh);
        const Vector3 along = size * Vector3(R[0], R[4], R[8]), up = Vector3(R[2], R[6], R[10]);
        const Vector3 place = one_in(2) ? Vector3(0.5 * along) : Vector3::Zero();
        Vector3 towards = direction();
        if (!one_in(3))
            towards = ((one_in(2) ? -1 : 1) * up + (one_in(2) ? 0.01 : 0.3) * towards).normalized();
        double low = 0, high = 8 * size;
        for (int i = 0; i < 60; ++i)
        {
            const double middle = 0.5 * (low + high);
            put(second, place, towards, middle);
            (touch(mesh, second) ? low : high) = middle;
        }
        put(second, place, towards, low);
    }

    // Only the shape test decides, as if the boxes overlapped.
    bool may_touch(dGeomID first, dGeomID second)
    {
        const std::vector<dxGeom *> geoms{first, second};
        HullStore hulls;
        GeomScene scene(geoms, hulls, HullMaker::all_steps, false);
        ProxyStore proxies;
        proxies.add();
        proxies.add();
        MeasuredShapes shapes;
        shapes.start(2);
        shapes.update(scene, proxies.members(), proxies);
        const OverlapTest boxes{scene, proxies.places.data(), false, Origin().doubt(), Float4::all(0)};
        GapCache cache(Payer::none);
        GapBudget budget;
        std::uint64_t gap_checks = 0;
        return ShapeTest{boxes, proxies, shapes, 0, gap_checks}.check_gap({0, 1}, cache, budget);
    }

    double thinnest_ = 0.03; // shortest side, relative to the size
    double smallest_ = 0.01; // size, relative to the other's
    struct Counts
    {
        long contacts = 0, left_out = 0;
    };

    void look_at(dGeomID first, dGeomID second, Counts &counts)
    {
        const bool touching = touch(first, second), reported = may_touch(first, second);
        EXPECT_FALSE(touching && !reported) << "classes " << dGeomGetClass(first) << " and " << dGeomGetClass(second);
        counts.contacts += touching;
        counts.left_out += !reported;
        destroy(first, second);
    }

    void destroy(dGeomID first, dGeomID second)
    {
        dGeomDestroy(first);
        dGeomDestroy(second);
        convexes_.clear();
        meshes_.clear();
    }

    void expect_no_contact_left_out(int one, int other, int poses)
    {
        Counts counts;
        bool by_shape = false; // a class that is always tested by box needs few poses
        for (int i = 0; i < poses && (by_shape || i < 50) && !HasFailure(); ++i)
        {
            const double size = log_between(1e-3, 1e2);
            dGeomID first = create(one, size),
                    second = create(other, one_in(2) ? size : size * log_between(smallest_, 1));
            by_shape |= judged_by_shape(made_shape(first), made_shape(second));
            for (dGeomID geom : {first, second})
                if (dGeomGetClass(geom) != dPlaneClass)
                    turn(geom);
            nearly_touch(first, second, size);
            look_at(first, second, counts);
        }
        if (!by_shape)
            return;
        EXPECT_GT(counts.contacts, poses / 20) << "classes " << one << " and " << other;
        EXPECT_GT(counts.left_out, poses / 60) << "classes " << one << " and " << other;
    }

    void look_at_hills(int type, Counts &counts)
    {
        thinnest_ = one_in(2) ? 0.03 : 1e-4;
        const double size = log_between(1e-2, 1e2), size_of_other = size * log_between(1e-3, 1);
        const bool is_placeable = one_in(2);
        const Hills hills(random_, size, size * log_between(1e-2, 1));
        const dGeomID ground = dCreateHeightfield(nullptr, hills.id(), is_placeable),
                      other = create(type, size_of_other);
        turn(other);
        if (is_placeable)
        {
            turn(ground);
            if (one_in(2))
                put(ground, Vector3::Zero(), direction(), size * log_between(1, 1e3));
        }
        try
        {
            nearly_touch_surface(ground, place_on(ground, hills, is_placeable), other, size_of_other);
            look_at(ground, other, counts);
        }
        catch (const OdeAbort &) // ODE has an assertion about boxes that touch the edge of a heightfield
        {
            destroy(ground, other);
        }
    }

    // Places of the bounding box of a shape relative to a heightfield: each one at which ODE's collider ends early, continues
    // with a plane or wraps. A box is put at the border of such a decision, or slightly beyond it.
    enum class Border
    {
        above,         // the bottom of the box at the highest sample
        below,         // the top of the box at the lowest sample beside it
        below_thick,   // somewhere below the lowest sample beside it
        side,          // beyond a side, at any height
        corner,        // beyond a corner, at any height
        below_side,    // beyond a side, the top of the box at the lowest sample beside it
        below_corner,  // beyond a corner, likewise
        out_of_bounds, // a side of the box at a side of the heightfield
        on_sample,     // around a sample
        copies_away,   // some periods away, at a seam
        copies_far     // so many periods away that ODE's numbers of cells may be too large for an int
    };
    static constexpr std::array borders{Border::above,        Border::below,         Border::below_thick,
                                        Border::side,         Border::corner,        Border::below_side,
                                        Border::below_corner, Border::out_of_bounds, Border::on_sample,
                                        Border::copies_away,  Border::copies_far};

    double nearly_zero(double size) { return one_in(4) ? 0 : (one_in(2) ? -1 : 1) * size * log_between(1e-12, 1e-1); }

    double beyond(double side, double half) { return (one_in(2) ? -1 : 1) * (0.5 * side + between(-0.2, 1) * half); }

    Vector3 centre_at(Border border, const Hills &hills, const Vector3 &half)
    {
        const int column = static_cast<int>(random_() % static_cast<unsigned>(hills.columns())),
                  row = static_cast<int>(random_() % static_cast<unsigned>(hills.rows()));
        const Vector3 sides = hills.sides();
        Vector3 place(between(-0.5, 0.5) * sides.x(), hills.height(column, row) + between(-2, 2) * half.y(),
                      between(-0.5, 0.5) * sides.z());
        switch (border)
        {
        case Border::above:
            place.y() = hills.highest() + half.y() + nearly_zero(half.y());
            break;
        case Border::below:
        case Border::below_thick:
            break;
        case Border::side:
        case Border::below_side:
            if (one_in(2))
                place.x() = beyond(sides.x(), half.x());
            else
                place.z() = beyond(sides.z(), half.z());
            break;
        case Border::corner:
        case Border::below_corner:
            place.x() = beyond(sides.x(), half.x());
            place.z() = beyond(sides.z(), half.z());
            break;
        case Border::out_of_bounds:
            place.x() = (one_in(2) ? -1 : 1) * (0.5 * sides.x() + half.x() + nearly_zero(half.x()));
            break;
        case Border::on_sample:
            place.x() = column * hills.cell().x() - 0.5 * sides.x() + nearly_zero(half.x());
            place.z() = row * hills.cell().z() - 0.5 * sides.z() + nearly_zero(half.z());
            break;
        case Border::copies_away:
            place.x() += sides.x() * std::round(between(-5, 5));
            place.z() = sides.z() * (std::round(between(-5, 5)) + 0.5) + nearly_zero(half.z());
            break;
        case Border::copies_far:
            place.x() += (one_in(2) ? -1 : 1) * sides.x() * log_between(1e7, 1e13);
        }
        const double lowest = hills.lowest_beside(place, half);
        if (border == Border::below_thick)
            place.y() = lowest - half.y() * between(1, 3);
        if (border == Border::below || border == Border::below_side || border == Border::below_corner)
            place.y() = lowest - half.y() - nearly_zero(half.y());
        return place;
    }

    void put_elsewhere(dGeomID ground, dGeomID other, double size)
    {
        turn(ground);
        put(ground, Vector3::Zero(), direction(), one_in(2) ? 0 : size * log_between(1, 1e3));
        const dReal *own = dGeomGetRotation(other), *at = dGeomGetPosition(other), *turned = dGeomGetRotation(ground);
        dVector3 place;
        dGeomGetRelPointPos(ground, at[0], at[1], at[2], place);
        dMatrix3 together;
        dMultiply0(together, turned, own, 3, 3, 3);
        for (int i = 0; i < 3; ++i)
            together[4 * i + 3] = 0;
        dGeomSetRotation(other, together);
        dGeomSetPosition(other, place[0], place[1], place[2]);
    }

    // Cells are up to a thousand times as high as wide.
    void look_at_border(int type, Border border, Counts &counts)
    {
        thinnest_ = one_in(2) ? 0.2 : 1e-3;
        const double size = log_between(1e-2, 1e2), size_of_other = size * log_between(1e-2, 2);
        const Hills hills(random_, size, size * log_between(1e-2, 1e2));
        const bool is_placeable = one_in(2);
        const dGeomID ground = dCreateHeightfield(nullptr, hills.id(), is_placeable),
                      other = create(type, size_of_other);
        if (!one_in(4))
            turn(other);
        dReal box[6];
        dGeomGetAABB(other, box);
        const Vector3 low(box[0], box[2], box[4]), high(box[1], box[3], box[5]);
        put(other, centre_at(border, hills, 0.5 * (high - low)) - 0.5 * (low + high), Vector3::Zero(), 0);
        if (is_placeable)
            put_elsewhere(ground, other, size);
        try
        {
            look_at(ground, other, counts);
        }
        catch (const OdeAbort &) // as above
        {
            destroy(ground, other);
        }
    }

    std::deque<ConvexArrays> convexes_;
    std::deque<MeshArrays> meshes_;
    std::mt19937_64 random_{20261123};
};

constexpr std::array<int, 7> classes{dSphereClass, dBoxClass,    dCapsuleClass, dCylinderClass,
                                     dPlaneClass,  dConvexClass, dTriMeshClass};

TEST_F(ShapeColliders, FindNoContactOfPairsThatAreLeftOut)
{
    constexpr int poses = is_long ? 400000 : of_cases(12000);
    for (int one : classes)
        for (int other : classes)
            expect_no_contact_left_out(one, other, poses);
}

TEST_F(ShapeColliders, FindNoContactOfThinPairsThatAreLeftOut)
{
    constexpr int poses = is_long ? 200000 : 3000;
    thinnest_ = 1e-6;
    smallest_ = 1e-4;
    for (int one : classes)
        for (int other : classes)
            expect_no_contact_left_out(one, other, poses);
}

// Single-precision normals of slivers are inaccurate. Once, contacts with boxes and with other slivers were left out.
TEST_F(ShapeColliders, FindNoContactBesideSliversOfPairsThatAreLeftOut)
{
    constexpr int poses = is_long ? 400000 : of_cases(40000);
    for (int type : {dSphereClass, dBoxClass, dCapsuleClass, dCylinderClass, dTriMeshClass})
    {
        Counts counts;
        for (int i = 0; i < poses && !HasFailure(); ++i)
        {
            const double size = log_between(1e-1, 10);
            const dGeomID mesh = create_slivers(size), other = create_thin(type, size);
            turn(mesh);
            turn(other);
            barely_touch(mesh, other, size);
            look_at(mesh, other, counts);
        }
        EXPECT_GT(counts.contacts, poses / 40) << "class " << type;
    }
}

// The hull of a mesh does not help within it.
TEST_F(ShapeColliders, FindNoContactBesideSurfacesOfPairsThatAreLeftOut)
{
    constexpr int poses = is_long ? 400000 : of_cases(2400);
    for (int type : {dSphereClass, dBoxClass, dCapsuleClass, dCylinderClass, dTriMeshClass})
    {
        Counts counts;
        for (int i = 0; i < poses && !HasFailure(); ++i)
        {
            thinnest_ = one_in(2) ? 0.03 : 1e-4;
            const double size = log_between(1e-2, 1e2), size_of_other = size * log_between(1e-3, 1);
            const dGeomID ground = create_ground(size), other = create(type, size_of_other);
            turn(ground);
            turn(other);
            if (one_in(2))
                put(ground, Vector3::Zero(), direction(), size * log_between(1, 1e3));
            nearly_touch_surface(ground, place_on(ground), other, size_of_other);
            look_at(ground, other, counts);
        }
        EXPECT_GT(counts.contacts, poses / 20) << "class " << type;
        EXPECT_GT(counts.left_out, poses / (type == dTriMeshClass ? 60 : 20)) << "class " << type;
    }
}

// ODE's collider of heightfields compares bounding boxes first, then planes of triangles; edges and repeated ground have special
// rules in it.
TEST_F(ShapeColliders, FindNoContactWithHeightfieldsOfPairsThatAreLeftOut)
{
    constexpr int poses = is_long ? 400000 : of_cases(6000);
    for (int type : {dSphereClass, dBoxClass, dCapsuleClass, dCylinderClass, dConvexClass, dTriMeshClass})
    {
        Counts counts;
        for (int i = 0; i < poses && !HasFailure(); ++i)
            look_at_hills(type, counts);
        EXPECT_GT(counts.contacts, poses / 20) << "class " << type;
        EXPECT_GT(counts.left_out, poses / 20) << "class " << type;
    }
}

// Below the corner of a steep heightfield a sphere is outside the planes of all triangles, and ODE finds a contact because its
// box is lower than the ground. Once, the pair was left out.
TEST_F(ShapeColliders, FindNoContactAtBordersOfHeightfieldsOfPairsThatAreLeftOut)
{
    constexpr int poses = is_long ? 400000 : of_cases(2000);
    for (int type : {dSphereClass, dBoxClass, dCapsuleClass, dCylinderClass, dConvexClass, dTriMeshClass})
        for (Border border : borders)
        {
            Counts counts;
            for (int i = 0; i < poses && !HasFailure(); ++i)
                look_at_border(type, border, counts);
            EXPECT_GT(counts.contacts, border == Border::out_of_bounds ? 0 : poses / 100)
                << "class " << type << ", border " << static_cast<int>(border);
            ASSERT_FALSE(HasFailure()) << "class " << type << ", border " << static_cast<int>(border);
        }
}
} // namespace
} // namespace ode_predictive_space
