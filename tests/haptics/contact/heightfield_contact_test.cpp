// Contact with heightfields whose samples are set: both laws, both loops.

#include "tests/haptics/contact/contact_fixture.h"
#include "tests/haptics/support/random_numbers.h"

#include "ode_predictive_space/haptics/contact/mesh_store.h"

namespace ode_predictive_space::haptics
{
namespace
{
HeightfieldSamples profile(double cell, int cells, const std::function<double(double x)> &height)
{
    HeightfieldSamples samples;
    samples.width = samples.depth = cell * cells;
    samples.width_samples = samples.depth_samples = cells + 1;
    samples.scale = 0.5; // stored heights are 2 h - 1
    samples.offset = 0.5;
    for (int z = 0; z <= cells; ++z)
        for (int x = 0; x <= cells; ++x)
            samples.heights.push_back(2 * (height(cell * (x - cells / 2.0)) - 0.5));
    return samples;
}

class HeightfieldContactTest : public ContactTest
{
protected:
    void use(const OdeField &field)
    {
        field.add_upright(world_.space);
        prepare_ = [&field](HapticProbe &probe) { probe.sensor()->set_samples(field.data(), field.samples()); };
    }
};

INSTANTIATE_TEST_SUITE_P(Laws, HeightfieldContactTest, contact_tests, contact_test_name);

TEST_P(HeightfieldContactTest, RidgesAreCrossedWithoutAJump)
{
    const RidgeShape ridges;
    const OdeField field(profile(ridges.cell, 100, [&](double x) { return ridges.height(x); }));
    use(field);
    physics_rate_ = 100;
    const auto samples = run(
        [](double t) {
            const Vector3 above(-0.08, -0.02, 0.03), in(-0.08, -0.02, radius - 0.003), end(0.08, 0.02, radius - 0.003);
            return t < 0.5 ? between(above, in, 0.1, 0.3, t) : between(in, end, 0.5, 0.5, t);
        },
        1.1);
    expect_forces_of_ridges(samples, ridges, 500);
}

TEST_P(HeightfieldContactTest, OtherSamplesEndTheContact)
{
    const OdeField field(profile(0.02, 20, [](double) { return 0.0; }));
    use(field);
    HeightfieldSamples lower = field.samples();
    lower.offset -= 0.05;
    const auto samples = run(
        [](double t) {
            return between({0, 0, 0.03}, {0, 0, -0.02}, 0.1, 0.3, t);
        },
        1, Once(clock_, 0.7, [&] { probe_->sensor()->set_samples(field.data(), lower); }));
    for (const Sample &sample : samples)
        if (sample.time > 0.5 && sample.time < 0.699)
        {
            ASSERT_NEAR(sample.requested.z(), k * 0.03, 1e-9) << sample.time;
        }
    expect_no_force(samples, 0.7051, infinity);
}

TEST(HeightfieldContact, WithoutSamplesItIsThePlaneThatOdeFinds)
{
    const OdeUse ode;
    ProbeWorld world;
    const OdeField field(profile(0.02, 20, [](double) { return 0.0; }));
    field.add_upright(world.space);
    ScriptedDevice device([](double seconds) { return Vector3(0.003, 0.001, seconds > 0 ? 0.006 : 0.011); });
    HapticProbe probe(device, world.space, radius, RenderSettings());
    world.run(probe, 1); // the probe is still outside
    world.run(probe, 1);
    EXPECT_NEAR(probe.touches().at(0).depth, 0.004, 1e-6);
    probe.sensor()->set_samples(field.data(), field.samples());
    world.run(probe, 1);
    EXPECT_NEAR(probe.touches().at(0).depth, 0.004, 1e-12);
    probe.sensor()->forget_samples(field.data());
    world.run(probe, 1);
    EXPECT_NEAR(probe.touches().at(0).depth, 0.004, 1e-6);
}

TEST(HeightfieldContact, AFieldThatCannotBePlacedIsHeldWhereItIs)
{
    const OdeUse ode;
    ProbeWorld world;
    const OdeField field(profile(0.02, 20, [](double) { return 0.0; }));
    dCreateHeightfield(world.space, field.data(), 0);
    ScriptedDevice device([](double t) { return between({0, 0.03, 0}, {0, -0.04, 0}, 0.1, 0.3, t); });
    HapticProbe probe(device, world.space, radius, RenderSettings());
    probe.sensor()->set_samples(field.data(), field.samples());
    world.run(probe, 500);
    EXPECT_NEAR(probe.last_tick().requested.y(), 0.05 * 500, 1e-9);
}

TEST(HeightfieldContact, SamplesThatMakeNoFieldAreRefused)
{
    const OdeUse ode;
    ProbeWorld world;
    TouchSensor sensor(world.space, radius);
    const OdeField field(profile(0.02, 20, [](double) { return 0.0; }));
    HeightfieldSamples samples = field.samples();
    samples.heights.pop_back();
    EXPECT_THROW(sensor.set_samples(field.data(), samples), std::invalid_argument);
    for (double HeightfieldSamples::*const side : {&HeightfieldSamples::width, &HeightfieldSamples::depth})
    {
        samples = field.samples();
        samples.*side = 0;
        EXPECT_THROW(sensor.set_samples(field.data(), samples), std::invalid_argument);
    }
    for (int HeightfieldSamples::*const count :
         {&HeightfieldSamples::width_samples, &HeightfieldSamples::depth_samples})
    {
        samples = field.samples();
        samples.*count = 1;
        samples.heights.resize(21);
        EXPECT_THROW(sensor.set_samples(field.data(), samples), std::invalid_argument);
    }
}

/// ODE's rays show the true surface: the order of rows and columns, and the diagonals of the cells.
TEST(HeightfieldContact, TheSurfaceIsWhereOdeHasIt)
{
    const OdeUse ode;
    RandomNumbers random(7);
    HeightfieldSamples samples;
    samples.width = 0.6;
    samples.depth = 0.4;
    samples.width_samples = 7;
    samples.depth_samples = 9;
    samples.scale = 0.3;
    samples.offset = -0.1;
    for (int i = 0; i < 7 * 9; ++i)
        samples.heights.push_back(random.in_cube(0.2).x());
    const OdeField field(samples);
    const dGeomID geom = dCreateHeightfield(nullptr, field.data(), 1);
    MeshStore store;
    store.set_samples(field.data(), samples);
    const auto tree = store.tree_of(geom, {});
    ASSERT_TRUE(tree);
    EXPECT_EQ(tree->count(), 2u * 6 * 8);
    const dGeomID ray = dCreateRay(nullptr, 4);
    int hits = 0;
    for (int i = 0; i < 1000; ++i)
    {
        const Vector3 place = random.in_cube(0.5);
        dGeomRaySet(ray, 0.58 * place.x(), 2, 0.38 * place.z(), 0, -1, 0);
        dContactGeom contact;
        if (dCollide(ray, geom, 1, &contact, sizeof contact) == 1)
        {
            ++hits;
            SurfaceFeatures features;
            EXPECT_LE(tree->collect({contact.pos[0], contact.pos[1], contact.pos[2]}, 1, features), 1e-6);
        }
    }
    EXPECT_GT(hits, 900);
    dGeomDestroy(ray);
    dGeomDestroy(geom);
}
} // namespace
} // namespace ode_predictive_space::haptics
