// Reports of the sphere test are a function of the present geoms, and of nothing else.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Ball
{
    std::array<double, 3> centre;
    double radius; // infinite: the geom is tested by its box
};

// Largest difference of the products of two columns of the rotation matrix from those of a rotation. The last column of a ray
// is its direction, and its other columns have no meaning.
double skew_of(dGeomID geom)
{
    const dReal *R = dGeomGetRotation(geom);
    double skew = 0;
    for (int i = dGeomGetClass(geom) == dRayClass ? 2 : 0; i < 3; ++i)
        for (int j = dGeomGetClass(geom) == dRayClass ? 2 : 0; j <= i; ++j)
            skew = std::max(skew, std::abs(double{R[i]} * R[j] + double{R[4 + i]} * R[4 + j] +
                                           double{R[8 + i]} * R[8 + j] - (i == j ? 1 : 0)));
    return skew;
}

// These geoms can be touched outside any sphere around their box.
bool is_judged_by_box(dGeomID geom)
{
    const int type = dGeomGetClass(geom);
    if (type == dHeightfieldClass || type == dGeomTransformClass || type >= dFirstUserClass)
        return true;
    return type != dSphereClass && type != dPlaneClass && skew_of(geom) > 1e-4;
}

double own_radius(dGeomID geom)
{
    dVector3 sides;
    dReal radius = 0, length = 0;
    switch (dGeomGetClass(geom))
    {
    case dSphereClass:
        return dGeomSphereGetRadius(geom);
    case dBoxClass:
        dGeomBoxGetLengths(geom, sides);
        return std::sqrt(sides[0] * sides[0] + sides[1] * sides[1] + sides[2] * sides[2]) / 2;
    case dCapsuleClass:
        dGeomCapsuleGetParams(geom, &radius, &length);
        return radius + length / 2;
    case dCylinderClass:
        dGeomCylinderGetParams(geom, &radius, &length);
        return std::hypot(radius, length / 2);
    default:
        return infinity;
    }
}

// Spheres, boxes, capsules and cylinders have their own ball; all others have the one around their bounding box.
Ball ball_of(dGeomID geom)
{
    dReal box[6];
    dGeomGetAABB(geom, box);
    double half = 0;
    Ball ball{};
    if (!std::all_of(box, box + 6, [](dReal side) { return std::isfinite(side); }))
    {
        ball.radius = infinity;
        return ball;
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
        ball.centre[i] = (box[2 * i] + box[2 * i + 1]) / 2;
        half += (box[2 * i + 1] - box[2 * i]) * (box[2 * i + 1] - box[2 * i]) / 4;
    }
    ball.radius = own_radius(geom);
    if (is_judged_by_box(geom))
        ball.radius = infinity;
    else if (ball.radius == infinity)
        ball.radius = std::sqrt(half);
    return ball;
}

// Empty if rounding decides.
using Answer = std::optional<bool>;

Answer balls_touch(const Ball &one, const Ball &other)
{
    const double reach = one.radius + other.radius;
    double distance = 0;
    for (std::size_t i = 0; i < 3; ++i)
        distance = std::hypot(distance, one.centre[i] - other.centre[i]);
    if (!std::isfinite(reach) || !std::isfinite(distance))
        return true;
    constexpr double rounding = 1e-4;
    return std::abs(distance - reach) < rounding * (1 + reach) ? std::nullopt : Answer(distance < reach);
}

bool meets(dGeomID ray, const dReal *box, double margin)
{
    const dReal *start = dGeomGetPosition(ray), *R = dGeomGetRotation(ray);
    double enter = 0, leave = dGeomRayGetLength(ray);
    for (std::size_t i = 0; i < 3; ++i)
    {
        const double direction = R[4 * i + 2], low = box[2 * i] - margin - start[i],
                     high = box[2 * i + 1] + margin - start[i];
        if (std::abs(direction) < 1e-12)
        {
            if (low > 0 || high < 0)
                return false;
            continue;
        }
        enter = std::max(enter, std::min(low / direction, high / direction));
        leave = std::min(leave, std::max(low / direction, high / direction));
    }
    return enter <= leave;
}

Answer line_meets(dGeomID ray, dGeomID other)
{
    if (dGeomGetClass(ray) != dRayClass || is_judged_by_box(ray) || is_judged_by_box(other) ||
        dGeomGetClass(other) == dConvexClass)
        return true;
    dReal box[6];
    dGeomGetAABB(other, box);
    constexpr double margin = sizeof(dReal) == sizeof(double) ? 1e-5 : 1e-2; // round-off lets rays hit beside the box
    const bool widely = meets(ray, box, margin), narrowly = meets(ray, box, -1e-5);
    return widely == narrowly ? Answer(widely) : std::nullopt;
}

Answer both(const Answer &one, const Answer &other)
{
    if (one == Answer(false) || other == Answer(false))
        return false;
    return one && other ? Answer(true) : std::nullopt;
}

// ODE uses libccd for these contacts, and libccd finds some between shapes that are apart.
bool is_found_by_libccd(dGeomID one, dGeomID other)
{
    const std::set<int> cylinders = {dBoxClass, dCapsuleClass, dCylinderClass},
                        solids = {dSphereClass, dBoxClass, dCapsuleClass, dCylinderClass, dConvexClass, dTriMeshClass};
    const auto is_found = [&](int type, int other) {
        return (type == dConvexClass && solids.count(other)) || (type == dCylinderClass && cylinders.count(other));
    };
    return is_found(dGeomGetClass(one), dGeomGetClass(other)) || is_found(dGeomGetClass(other), dGeomGetClass(one));
}

Answer by_definition(dGeomID one, dGeomID other)
{
    if (is_found_by_libccd(one, other))
        return true;
    return both(balls_touch(ball_of(one), ball_of(other)), both(line_meets(one, other), line_meets(other, one)));
}

bool boxes_overlap(dGeomID one, dGeomID other)
{
    const bool one_body = dGeomGetBody(one) && dGeomGetBody(one) == dGeomGetBody(other);
    dReal a[6], b[6];
    dGeomGetAABB(one, a);
    dGeomGetAABB(other, b);
    return !one_body && !(a[0] > b[1] || a[1] < b[0] || a[2] > b[3] || a[3] < b[2] || a[4] > b[5] || a[5] < b[4]);
}

using GeomPairs = std::vector<std::pair<dGeomID, dGeomID>>;

class Room
{
public:
    /// @param calm geoms that have bodies fly on for many ticks.
    Room(unsigned seed, bool calm) : random_(seed), calm_(calm)
    {
        dPredictiveSpaceSetProximity(space(), dPredictiveProximitySphere);
        for (int i = 0; i < 26; ++i)
            add(i % geom_kind_count == static_cast<int>(GeomKind::user)
                    ? GeomKind::trimesh // the user class filters its pairs itself
                    : static_cast<GeomKind>(i % geom_kind_count));
    }

    dSpaceID space() const { return scenario_.space(); }
    dGeomID geom(int number) const { return geoms_[static_cast<std::size_t>(number)].id; }
    int count() const { return static_cast<int>(geoms_.size()); }

    void change()
    {
        for (int i = calm_ ? one_in(20) : one_in(4) ? 8 : 1; i > 0; --i)
        {
            Slot &slot = geoms_[random_() % geoms_.size()];
            if (is_placeable(slot.kind))
                change(slot);
        }
        scenario_.step(0.01);
    }

    GeomPairs by_boxes() const
    {
        GeomPairs pairs;
        for (int i = 0; i < count(); ++i)
            for (int j = i + 1; j < count(); ++j)
                if (boxes_overlap(geom(i), geom(j)))
                    pairs.emplace_back(geom(i), geom(j));
        return pairs;
    }
    GeomPairs by_boxes(dGeomID probe) const
    {
        GeomPairs pairs;
        for (int i = 0; i < count(); ++i)
            if (boxes_overlap(probe, geom(i)))
                pairs.emplace_back(probe, geom(i));
        return pairs;
    }

    // The matrix of the ray is at times no rotation.
    void shoot(dGeomID ray)
    {
        dGeomRaySet(ray, place(), place(), place(), place(), place(), place());
        dQuaternion turn;
        draw_quaternion(turn);
        if (one_in(4))
            dGeomSetQuaternion(ray, turn);
    }

private:
    struct Slot
    {
        dGeomID id;
        GeomKind kind;
    };

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    bool one_in(unsigned count) { return random_() % count == 0; }
    dReal length() { return static_cast<dReal>(between(0.05, 1)); }
    dReal place() { return static_cast<dReal>(between(-3, 3)); }

    void add(GeomKind kind)
    {
        const dGeomID geom = scenario_.numbered(create_geom(kind, length(), space()));
        geoms_.push_back({geom, kind});
        if (!is_placeable(kind))
            return;
        dGeomSetPosition(geom, place(), place(), place());
        if (one_in(2))
            scenario_.body(geom, place() / 2, place() / 2, place() / 2);
    }

    // Not all quaternions have unit length: ODE makes a matrix that is no rotation from these, if the geom has no body.
    void draw_quaternion(dQuaternion turn)
    {
        for (int i = 0; i < 4; ++i)
            turn[i] = static_cast<dReal>(between(-1, 1));
        if (one_in(2))
            dNormalize4(turn);
    }

    void change(Slot &slot)
    {
        const dBodyID body = dGeomGetBody(slot.id);
        dQuaternion turn;
        draw_quaternion(turn);
        switch (random_() % 8)
        {
        case 0:
            return dGeomSetPosition(slot.id, place(), place(), place());
        case 1:
        case 2:
            return dGeomSetQuaternion(slot.id, turn);
        case 3:
            return resize_geom(slot.id, slot.kind, length());
        case 4:
            if (!body)
                return static_cast<void>(scenario_.body(slot.id, 0, 0, 0));
            return dGeomSetBody(slot.id, nullptr);
        case 5:
            return move_in_body(slot.id, turn);
        default:
            if (body)
                return throw_body(body);
            return dGeomSetPosition(slot.id, dGeomGetPosition(slot.id)[0] + length() / 10, place() / 3, place() / 3);
        }
    }

    void throw_body(dBodyID body)
    {
        dBodySetLinearVel(body, place(), place(), place());
        dBodySetAngularVel(body, place(), place(), place());
        if (one_in(2))
            dBodySetPosition(body, place(), place(), place());
    }

    void move_in_body(dGeomID geom, const dQuaternion turn)
    {
        if (!dGeomGetBody(geom))
            return;
        if (one_in(2))
            return dGeomClearOffset(geom);
        dGeomSetOffsetPosition(geom, length(), 0, 0);
        dGeomSetOffsetQuaternion(geom, turn);
    }

    std::mt19937_64 random_;
    bool calm_;
    Scenario scenario_{SpaceKind::predictive};
    std::vector<Slot> geoms_;
};

// Expects pairs that follow the definition. @return the number of pairs whose boxes overlap but that are not reported.
int compare(const GeomPairs &by_boxes, Pairs reported, const std::string &when)
{
    reported = unordered(reported);
    int left_out = 0;
    for (const auto &[one, other] : by_boxes)
    {
        const Pair pair = std::minmax(geom_number(one), geom_number(other));
        const bool is_reported = std::binary_search(reported.begin(), reported.end(), pair);
        const Answer expected = by_definition(one, other);
        EXPECT_EQ(is_reported, expected.value_or(is_reported))
            << when << ": classes " << dGeomGetClass(one) << " and " << dGeomGetClass(other);
        left_out += !is_reported;
    }
    EXPECT_EQ(reported.size() + static_cast<std::size_t>(left_out), by_boxes.size()) << when;
    return left_out;
}

std::string at(unsigned seed, int tick)
{
    return "seed " + std::to_string(seed) + ", tick " + std::to_string(tick);
}
class ReportBySphere : public OdeTest
{};

TEST_F(ReportBySphere, FollowsFromTheGeomsAlone)
{
    int left_out = 0;
    for (unsigned seed = 0; seed < 40 && !HasFailure(); ++seed)
    {
        Room room(seed, seed % 2 == 0);
        for (int tick = 0; tick < 300 && !HasFailure(); ++tick)
        {
            room.change();
            left_out += compare(room.by_boxes(), collide(room.space()), at(seed, tick));
            EXPECT_EQ(dPredictiveSpaceValidate(room.space()), 1) << at(seed, tick);
        }
    }
    EXPECT_GT(left_out, 500) << "the measure made no difference";
}

TEST_F(ReportBySphere, AnswersARayFromTheGeomsAlone)
{
    int left_out = 0;
    for (unsigned seed = 100; seed < 120 && !HasFailure(); ++seed)
    {
        Room room(seed, false);
        const dGeomID ray = number_geom(dCreateRay(nullptr, 3), 1000);
        for (int tick = 0; tick < 300 && !HasFailure(); ++tick)
        {
            room.change();
            if (tick % 3 == 0)
                collide(room.space());
            for (int i = 0; i < 10; ++i)
            {
                room.shoot(ray);
                left_out += compare(room.by_boxes(ray), collide2(ray, as_geom(room.space())), at(seed, tick));
            }
        }
        dGeomDestroy(ray);
    }
    EXPECT_GT(left_out, 500) << "the measure made no difference";
}

dGeomID create_plate(dSpaceID space)
{
    static const float corners[] = {3, -1, -1, 3, 1, -1, 3, 1, 1, 3, -1, 1};
    static const dTriIndex triangles[] = {0, 1, 2, 0, 2, 3};
    static const dTriMeshDataID data = [] {
        const dTriMeshDataID built = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(built, corners, 3 * sizeof(float), 4, triangles, 6, 3 * sizeof(dTriIndex));
        return built;
    }();
    return dCreateTriMesh(space, data, nullptr, nullptr, nullptr);
}

// Once, predictions used a smaller sphere around the mesh's position: the pair came later than in a new space.
TEST_F(ReportBySphere, ComesInTimeForAMeshOffItsOrigin)
{
    Scenario scene(SpaceKind::predictive);
    dPredictiveSpaceSetProximity(scene.space(), dPredictiveProximitySphere);
    const dGeomID mesh = scene.numbered(create_plate(scene.space())), sphere = scene.sphere(3, 12, 3, 0);
    scene.body(mesh, 0, 0, 0);
    scene.body(sphere, -1, 0, 0);
    int reported = 0;
    for (int tick = 0; tick < 900; ++tick)
    {
        scene.step(0.01);
        const Pairs pairs = collide(scene.space());
        reported += static_cast<int>(pairs.size());
        const GeomPairs by_boxes = boxes_overlap(mesh, sphere) ? GeomPairs{{mesh, sphere}} : GeomPairs{};
        compare(by_boxes, pairs, "tick " + std::to_string(tick));
        EXPECT_EQ(dPredictiveSpaceValidate(scene.space()), 1) << tick;
        if (HasFailure())
            break;
    }
    EXPECT_GT(reported, 200);
}

// Geoms that were tested by boxes before must be classified again.
TEST_F(ReportBySphere, AnswersARayAfterAChangeOfTheMeasure)
{
    Scenario scene(SpaceKind::predictive);
    const dGeomID box = scene.box(1, 0, 0, 0), ray = number_geom(dCreateRay(nullptr, 8), 1000);
    const dQuaternion longer = {1, 0, 0, 1};
    dGeomSetQuaternion(box, longer);
    dGeomRaySet(ray, -2, 1.2, 0, 0.6, 1, 0); // past a corner of the box's bounds
    collide(scene.space());
    const Pairs by_boxes = collide2(ray, as_geom(scene.space()));
    dPredictiveSpaceSetProximity(scene.space(), dPredictiveProximitySphere);
    EXPECT_EQ(collide2(ray, as_geom(scene.space())), by_boxes);
    EXPECT_EQ(by_boxes.size(), 1u);
    dGeomDestroy(ray);
}
} // namespace
} // namespace ode_predictive_space
