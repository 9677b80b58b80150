// A space that reports a pair only when its shapes may touch calls the probe less often than one that reports each pair of
// overlapping boxes. All forces are equal to the last bit, for both laws and both kinds of loops.

#include "tests/haptics/contact/contact_fixture.h"

#include <array>
#include <random>

namespace ode_predictive_space::haptics
{
namespace
{
enum class Measure
{
    boxes,
    shapes,
    sweep_and_prune
};

struct Things
{
    explicit Things(Measure measure)
        : world(measure == Measure::sweep_and_prune ? SpaceChoice::sweep_and_prune : SpaceChoice::predictive)
    {
        if (measure == Measure::shapes)
            dPredictiveSpaceSetProximity(space(), dPredictiveProximityShape);
    }

    /// Number of gap tests of the space.
    unsigned long gap_checks() const
    {
        dPredictiveSpaceCounters counters = {};
        if (dSpaceIsPredictive(space()) != 0)
            dPredictiveSpaceGetCounters(space(), &counters, sizeof counters);
        return counters.gap_checks;
    }

    dSpaceID space() const { return world.space; }

    /// Makes the geom move and turn, unaffected by contacts.
    void set_going(dGeomID geom, const Vector3 &position, const Vector3 &velocity, const Vector3 &spin)
    {
        const dBodyID body = world.add_body(position, 1);
        dBodySetKinematic(body);
        dGeomSetBody(geom, body);
        dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
        dBodySetAngularVel(body, spin.x(), spin.y(), spin.z());
    }

    dGeomID add_mesh(const MeshShape &shape)
    {
        meshes.push_back(std::make_unique<OdeMesh>(shape));
        return meshes.back()->add_to(space());
    }

    ProbeWorld world;
    std::vector<std::unique_ptr<OdeMesh>> meshes;
};

struct Scene
{
    const char *name;
    std::function<void(Things &)> build;
    ScriptedDevice::Path path;
    double duration; ///< s
};

void turn(dGeomID geom, double x, double y, double z, double angle)
{
    dMatrix3 rotation;
    dRFromAxisAndAngle(rotation, x, y, z, angle);
    dGeomSetRotation(geom, rotation);
}

/// Spheres, capsules, cylinders and boxes at all angles, so close together that the probe touches some of them wherever it is.
void add_crowd(Things &things, int count)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-0.1, 0.1);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < count; ++i)
    {
        const std::array<dGeomID, 4> one_of = {
            i % 4 == 0 ? dCreateSphere(things.space(), 0.012) : nullptr,
            i % 4 == 1 ? dCreateCapsule(things.space(), 0.004, 0.05) : nullptr,
            i % 4 == 2 ? dCreateBox(things.space(), 0.05, 0.04, 0.004) : nullptr,
            i % 4 == 3 ? dCreateCylinder(things.space(), 0.006, 0.04) : nullptr,
        };
        const dGeomID geom = one_of[static_cast<std::size_t>(i % 4)];
        // These are statements of their own because compilers order the evaluation of arguments differently.
        const double z = place(random), y = place(random), x = place(random);
        dGeomSetPosition(geom, x, y, z);
        const double angle = 3 * any(random), up = any(random) + 1.5, across = any(random), along = any(random);
        turn(geom, along, across, up, angle);
    }
}

Vector3 through_the_crowd(double t)
{
    return {0.09 * std::sin(2 * t), 0.09 * std::sin(3 * t + 0.5), 0.09 * std::cos(2.5 * t)};
}

void add_dented_mesh(Things &things)
{
    MeshShape shape = sheet_mesh(0.3, 12);
    for (Vector3 &vertex : shape.vertices)
        vertex.z() = 0.01 * std::sin(60 * vertex.x()) * std::cos(50 * vertex.y());
    turn(things.add_mesh(shape), 1, 1, 0, 0.5);
}

void add_moving_things(Things &things)
{
    const dGeomID plate = things.world.add_box({0.2, 0.2, 0.004}, {0, 0, 0});
    things.set_going(plate, {0, 0, -0.03}, {0, 0, 0.03}, {0.3, 0.5, 0});
    things.set_going(things.add_mesh(sphere_mesh(0.03, 16)), {0.1, 0, 0.02}, {-0.08, 0, 0}, {0, 2, 1});
    things.set_going(dCreateCapsule(things.space(), 0.01, 0.06), {-0.05, 0.05, 0.05}, {0.02, -0.03, -0.03}, {4, 0, 1});
    things.world.add_moving_box({0.04, 0.04, 0.04}, {0.02, 0.12, 0.02}, 0.2); // free: the hand pushes it
}

void add_convexes(Things &things)
{
    static const std::array<dReal, 12> points = {0.02,  0,      -0.01, -0.01, 0.018, -0.01,
                                                 -0.01, -0.018, -0.01, 0,     0,     0.025};
    static const std::array<unsigned, 16> faces = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3};
    static const std::array<dReal, 16> planes = [] {
        std::array<dReal, 16> found{};
        for (std::size_t face = 0; face < 4; ++face)
        {
            const auto at = [&](std::size_t corner) {
                const dReal *p = &points[3 * faces[4 * face + 1 + corner]];
                return Vector3(p[0], p[1], p[2]);
            };
            const Vector3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
            for (Eigen::Index i = 0; i < 3; ++i)
                found[4 * face + static_cast<std::size_t>(i)] = normal[i];
            found[4 * face + 3] = normal.dot(at(0));
        }
        return found;
    }();
    for (int i = 0; i < 5; ++i)
    {
        const dGeomID convex = dCreateConvex(things.space(), planes.data(), 4, points.data(), 4, faces.data());
        dGeomSetPosition(convex, 0.03 * (i - 2), 0, 0);
        turn(convex, 0, 0, 1, 0.4 * i);
    }
}

const Scene scenes[] = {
    {"crowd", [](Things &things) { add_crowd(things, 300); }, &through_the_crowd, 2.5},
    {"dented mesh", &add_dented_mesh,
     [](double t) { return Vector3(0.1 * std::sin(3 * t), 0.1 * std::cos(2 * t), 0.03 - 0.06 * std::sin(4 * t)); }, 2},
    {"moving things", &add_moving_things,
     [](double t) { return Vector3(0.03 * std::sin(5 * t), 0.09 * t, 0.03 - 0.02 * std::cos(7 * t)); }, 1.5},
    {"thin tilted wall at 10 m/s",
     [](Things &things) {
         turn(things.world.add_box({0.3, 0.3, 0.001}, {0, 0, 0}), 0, 1, 0, 1);
     },
     [](double t) {
         return between({-0.034, 0, 0.01}, {0.036, 0, 0.01}, 0.1, 0.007, t);
     },
     0.2},
    {"five radii into a tilted sheet", [](Things &things) { turn(things.add_mesh(sheet_mesh(0.3, 8)), 1, 0, 0, 0.7); },
     [](double t) {
         return t < 1 ? between({0, 0, 0.03}, {0, 0, -4 * radius}, 0.1, 0.8, t)
                      : between({0, 0, -4 * radius}, {0, 0, 0.03}, 1.1, 0.8, t);
     },
     2},
    {"convexes", &add_convexes,
     [](double t) { return Vector3(0.06 * std::sin(2 * t), 0.012 * std::sin(9 * t), 0.035 - 0.015 * t); }, 1.5},
};

struct Rendered
{
    Vector3 requested;                                       ///< N; the law's force
    Vector3 given;                                           ///< N; sent to the device
    Vector3 proxy;                                           ///< m; set by the proxy law only
    std::vector<std::tuple<double, double, double>> touches; ///< depth, x and z of the normal; in one thread only
};

struct Outcome
{
    std::vector<Rendered> ticks;
    std::uint64_t calls = 0;      ///< of the near callback, for the probe
    std::uint64_t met = 0;        ///< calls whose shapes touched
    std::uint64_t touching = 0;   ///< ticks with a force
    unsigned long gap_checks = 0; ///< gap tests of the space
};

class ShapeMeasureTest : public testing::TestWithParam<std::tuple<bool, bool>>
{
protected:
    bool proxy_law() const { return std::get<0>(GetParam()); }
    bool decoupled() const { return std::get<1>(GetParam()); }

    Outcome feel(const Scene &scene, Measure measure, bool own_geom)
    {
        Things things(measure);
        scene.build(things);
        Material properties;
        properties.stiffness = stiffness_;
        const auto proxy = std::make_shared<ProxyLaw>(properties);
        RenderSettings rendering;
        rendering.law = std::make_shared<PenaltyLaw>(properties);
        if (proxy_law())
            rendering.law = proxy;
        ScriptedDevice device(scene.path);
        const dGeomID capsule = own_geom ? dCreateCapsule(things.space(), 0.6 * radius, 2 * radius) : nullptr;
        const auto probe = own_geom ? std::make_unique<HapticProbe>(device, capsule, rendering)
                                    : std::make_unique<HapticProbe>(device, things.space(), radius, rendering);
        Outcome outcome;
        probe->set_recorder([&](const RenderedTick &tick) { note(tick, *probe, proxy->proxy(), outcome); });
        run(things, *probe, scene.duration, outcome);
        outcome.gap_checks = things.gap_checks();
        return outcome;
    }

    void note(const RenderedTick &tick, HapticProbe &probe, const Vector3 &proxy, Outcome &outcome) const
    {
        Rendered rendered{tick.requested, tick.wrench.force, proxy, {}};
        if (!decoupled())
            for (const Touch &touch : probe.touches())
                rendered.touches.emplace_back(touch.depth, touch.normal.x(), touch.normal.z());
        outcome.touching += rendered.requested.isZero(0) ? 0 : 1;
        outcome.ticks.push_back(std::move(rendered));
    }

    void run(Things &things, HapticProbe &probe, double duration, Outcome &outcome) const
    {
        SimulatedClock clock;
        HapticLoop loop(probe, simulated(clock, duration, decoupled(), 500));
        things.world.on_pair = [&](dGeomID first, dGeomID second) {
            if (first == probe.geom() || second == probe.geom())
            {
                dContactGeom contact;
                ++outcome.calls;
                outcome.met += dCollide(first, second, 1, &contact, sizeof contact) > 0 ? 1 : 0;
            }
        };
        loop.run({[&] { things.world.collide(probe); }, [&](double dt) { things.world.step(dt); }});
    }

    void expect_the_same(bool own_geom)
    {
        for (const Scene &scene : scenes)
        {
            SCOPED_TRACE(scene.name);
            const Outcome by_boxes = feel(scene, Measure::boxes, own_geom);
            const Outcome by_shapes = feel(scene, Measure::shapes, own_geom);
            EXPECT_GT(by_boxes.touching, 1U);
            EXPECT_LE(by_shapes.calls, by_boxes.calls);
            expect_equal(by_boxes.ticks, by_shapes.ticks);
        }
    }

    static void expect_equal(const std::vector<Rendered> &ticks, const std::vector<Rendered> &others)
    {
        ASSERT_EQ(ticks.size(), others.size());
        for (std::size_t i = 0; i < ticks.size(); ++i)
        {
            ASSERT_EQ(ticks[i].requested, others[i].requested) << "tick " << i;
            ASSERT_EQ(ticks[i].given, others[i].given) << "tick " << i;
            ASSERT_EQ(ticks[i].proxy, others[i].proxy) << "tick " << i;
            ASSERT_EQ(ticks[i].touches, others[i].touches) << "tick " << i;
        }
    }

    const OdeUse ode_;
    double stiffness_ = k; ///< N/m
};

INSTANTIATE_TEST_SUITE_P(Laws, ShapeMeasureTest, testing::Combine(testing::Bool(), testing::Bool()), contact_test_name);

TEST_P(ShapeMeasureTest, ASphereOfItsOwnFeelsTheSame)
{
    expect_the_same(false);
}

// Sweep and prune adds other pairs, in another order.
TEST_P(ShapeMeasureTest, ASphereOfItsOwnFeelsTheSameInAnotherSpace)
{
    const Scene &crowd = scenes[0];
    expect_equal(feel(crowd, Measure::boxes, false).ticks, feel(crowd, Measure::sweep_and_prune, false).ticks);
}

TEST_P(ShapeMeasureTest, AGeomOfTheProgramFeelsTheSame)
{
    expect_the_same(true);
}

TEST_P(ShapeMeasureTest, InACrowdItIsCalledForWhatTouchesItAlone)
{
    const Scene crowd = {"", [](Things &things) { add_crowd(things, 150); }, &through_the_crowd, 2.5};
    stiffness_ = 20; // so soft that the proxy follows at once and does not rest beside a geom while it catches up
    for (const bool own_geom : {false, true})
    {
        const Outcome by_boxes = feel(crowd, Measure::boxes, own_geom);
        const Outcome by_shapes = feel(crowd, Measure::shapes, own_geom);
        EXPECT_EQ(by_shapes.met, by_boxes.met);
        EXPECT_LE(by_shapes.calls, 0.7 * by_boxes.calls);
        if (!own_geom)
        {
            EXPECT_LE(by_shapes.calls, 1.01 * by_shapes.met) << "hardly a call in vain";
            EXPECT_LE(by_shapes.gap_checks, 0.3 * by_boxes.calls) << "although its size changes in nearly all ticks";
        }
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
