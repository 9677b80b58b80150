#include "ode_predictive_space/broadphase/broadphase.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
struct Kind
{
    const char *name;
    std::size_t objects;
    double spread; ///< half the side of the cube that holds them
    double speed;  ///< largest displacement per tick and axis
    double unrest; ///< chance of an unexpected change of an object in a tick
    double jumps;  ///< chance of a tick in which everything jumps
    double grid;   ///< all coordinates are multiples of it, so many objects touch exactly; 0: no grid
};

void PrintTo(const Kind &kind, std::ostream *out)
{
    *out << kind.name;
}

class RandomProgram
{
public:
    RandomProgram(const Kind &kind, std::uint64_t seed) : kind_(kind), random_(seed)
    {
        while (world_.members().size() < kind_.objects)
            world_.add(random_object());
    }

    World &world() { return world_; }

    void change_world()
    {
        world_.advance();
        const bool all_jump = random_.chance(kind_.jumps);
        for (ProxyId id : world_.members())
        {
            keep_inside(id);
            if (all_jump)
                world_.place(id, snapped(random_.vector(kind_.spread)));
            else if (random_.chance(kind_.unrest))
                surprise(id);
        }
        if (world_.members().size() < 2 * kind_.objects && random_.chance(20 * kind_.unrest))
            world_.add(random_object());
    }

    void change_settings()
    {
        Broadphase &broadphase = world_.broadphase;
        PredictionSettings settings = broadphase.settings();
        switch (random_.index(5))
        {
        case 0:
            return broadphase.set_proximity_test(random_.chance(0.5) ? ProximityTest::box : ProximityTest::sphere);
        case 1:
            settings.deviation[random_.index(2)] = Deviation{random_.uniform(0, 0.1), 0.01, 0.001};
            return broadphase.set_settings(settings);
        case 2:
            settings.deviation = {};
            return broadphase.set_settings(settings);
        case 3:
            settings.horizon.min_ticks = 1 + static_cast<std::uint32_t>(random_.index(5));
            settings.horizon.max_ticks = 5 + static_cast<std::uint32_t>(random_.index(2000));
            return broadphase.set_settings(settings);
        default:
            for (ProxyId id : world_.members())
                if (random_.chance(0.1))
                    broadphase.set_role(id, random_.chance(0.5) ? Role::fixed_interactive : Role::fixed_environment);
        }
    }

    Random &random() { return random_; }

private:
    Vector3 snapped(const Vector3 &vector) const
    {
        return kind_.grid > 0 ? Vector3((vector / kind_.grid).array().round() * kind_.grid) : vector;
    }

    Object random_object()
    {
        const Vector3 centre = snapped(random_.vector(kind_.spread));
        const Vector3 displacement = random_.chance(0.5) ? Vector3::Zero() : snapped(random_.vector(kind_.speed));
        const double size = kind_.grid > 0 ? 2 * kind_.grid : random_.uniform(0.05, 0.15);
        const Vector3 half =
            kind_.grid > 0 ? Vector3::Constant(size) : Vector3(0.5 * size * (Vector3::Ones() + random_.vector(0.5)));
        switch (random_.index(20))
        {
        case 0:
            return floor_below(-0.9 * kind_.spread);
        case 1:
            return box(centre, 10 * half, displacement, false);
        case 2:
        case 3:
            return box(centre, half, displacement, false);
        case 4:
            return block(centre, half, displacement, false);
        case 5:
        case 6:
            return block(centre, half, displacement, true);
        case 7:
        case 8:
        case 9:
            return box(centre, half, displacement, true);
        case 10:
        case 11:
            return capsule(centre, 0.7 * size, 0.5 * size, displacement);
        default:
            return ball(centre, size, displacement);
        }
    }

    void set_displacement(Object &object, const Vector3 &displacement)
    {
        object.displacement = displacement;
        if (object.velocity)
            object.velocity = displacement / World::step;
    }

    void keep_inside(ProxyId id)
    {
        Object &object = world_.object(id);
        Vector3 displacement = object.displacement;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(object.centre[axis]) > kind_.spread && object.centre[axis] * displacement[axis] > 0)
                displacement[axis] = -displacement[axis];
        if (displacement != object.displacement)
            set_displacement(object, displacement);
    }

    void surprise(ProxyId id)
    {
        Object &object = world_.object(id);
        switch (random_.index(14))
        {
        case 0:
            return world_.place(id, snapped(random_.vector(kind_.spread)));
        case 1:
            return set_displacement(object, Vector3::Zero());
        case 2:
        case 3:
            return set_displacement(object, snapped(random_.vector(kind_.speed)));
        case 4:
            return world_.remove(id);
        case 5:
            // Its box changes but its sphere does not.
            if (object.half.allFinite())
                world_.turn(id, random_.vector(1) + Vector3(1.5, 0, 0), random_.uniform(-3, 3));
            return;
        case 6:
            object.half *= 1.25;
            object.radius *= 1.25;
            world_.touch(id);
            return;
        case 7:
            object.half *= 0.75;
            object.radius *= 0.75;
            world_.touch(id);
            return;
        case 8:
            // The body reports a velocity that it does not have, or the object loses its body.
            object.velocity = random_.chance(0.5) ? std::optional<Vector3>(random_.vector(10)) : std::nullopt;
            world_.touch(id);
            return;
        case 9:
            return lose(id);
        case 10:
        case 11:
            // The broad phase gets no notice.
            object.enabled = !object.enabled;
            return;
        case 12:
            // The pose of a geom with an offset has to be computed first.
            object.has_pose = !object.has_pose;
            world_.touch(id);
            return;
        default:
            world_.touch(id);
            return;
        }
    }

    void lose(ProxyId id)
    {
        const double places[] = {nan, infinity, -infinity, 1e12, -1e20, 1e200, 3e200, -1e39};
        Vector3 centre = world_.object(id).centre;
        centre[static_cast<int>(random_.index(3))] = places[random_.index(8)];
        // Most come back at once, as lost objects all overlap each other.
        world_.place(id, centre);
        if (random_.chance(0.7))
            world_.place(id, snapped(random_.vector(kind_.spread)));
    }

    Kind kind_;
    Random random_;
    World world_;
};

class AnyWorld : public testing::TestWithParam<Kind>
{};

TEST_P(AnyWorld, ReportsExactlyTheOverlappingPairsAtEveryTick)
{
    const int ticks = GetParam().objects > 100 ? 60 : 600; // brute force is slow
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
    {
        RandomProgram program(GetParam(), seed);
        World &world = program.world();
        for (int tick = 0; tick < ticks; ++tick)
        {
            if (tick > 0)
                program.change_world();
            if (program.random().chance(0.01))
                program.change_settings();
            if (program.random().chance(0.05))
            {
                world.broadphase.catch_up(world);
                ASSERT_EQ(world.misplaced_object(), "") << "seed " << seed << ", caught up before tick " << tick;
                if (program.random().chance(0.5))
                {
                    world.broadphase.find_new_pairs(world);
                    ASSERT_EQ(world.violated_invariant(), "") << "seed " << seed << ", before tick " << tick;
                }
                if (program.random().chance(0.5))
                    program.change_world();
            }
            world.broadphase.tick(world);
            ASSERT_EQ(world.violated_invariant(), "") << "seed " << seed << ", tick " << tick;
            const Pairs expected = world.overlapping();
            ASSERT_EQ(sorted_pairs(world.report()), expected) << "seed " << seed << ", tick " << tick;
            ASSERT_EQ(sorted_pairs(world.report()), expected) << "seed " << seed << ", again " << tick;
        }
    }
}

TEST_P(AnyWorld, AnswersQueriesBetweenTicks)
{
    RandomProgram program(GetParam(), 9);
    World &world = program.world();
    for (int tick = 0; tick < 300; ++tick)
    {
        program.change_world();
        world.broadphase.catch_up(world);
        const Vector3 centre = program.random().vector(GetParam().spread);
        const Box asked(centre - Vector3::Constant(0.2), centre + Vector3::Constant(0.2));
        std::vector<ProxyId> found;
        world.broadphase.walk(BoxProbe(FloatBox::around(asked)), [&](ProxyId id) { found.push_back(id); });
        std::sort(found.begin(), found.end());
        ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
        for (ProxyId id : world.members())
            if (world.bounds(id).intersects(asked))
            {
                ASSERT_TRUE(std::binary_search(found.begin(), found.end(), id)) << "tick " << tick;
            }
        if (tick % 3 == 0)
        {
            ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping()) << "tick " << tick;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Broadphase, AnyWorld,
    testing::Values(Kind{"calm", 40, 1, 0.005, 0.001, 0, 0}, Kind{"restless", 40, 1, 0.02, 0.02, 0.01, 0},
                    Kind{"crowded", 40, 0.3, 0.01, 0.005, 0, 0}, Kind{"sparse", 60, 4, 0.05, 0.005, 0.003, 0},
                    Kind{"touching", 60, 2, 0.25, 0.01, 0.002, 0.125}, Kind{"jumping", 40, 1, 0.01, 0.01, 0.5, 0},
                    Kind{"tiny", 3, 0.2, 0.01, 0.02, 0.01, 0}, Kind{"many", 300, 2.3, 0.01, 0.005, 0.02, 0},
                    Kind{"many_touching", 280, 3.5, 0.25, 0.01, 0.02, 0.125}),
    [](const auto &info) { return info.param.name; });

TEST(Broadphase, TheSmallestObjectsThatThereAreAreApartIfTheyAre)
{
    for (double size : {1e-37, 1e-38, 1e-39, 1e-45})
    {
        World world;
        for (int i = 0; i < 5; ++i)
            world.add(ball({2.01 * size * i, 0, 0}, size, {0, 0, 0}));
        EXPECT_EQ(sorted_pairs(world.tick()), world.overlapping()) << size;
    }
}

TEST(Broadphase, NumbersAreUsedAgain)
{
    World world;
    const ProxyId first = world.add(ball({0, 0, 0}, 1, {0, 0, 0}));
    const ProxyId second = world.add(ball({1, 0, 0}, 1, {0, 0, 0}));
    EXPECT_EQ(world.tick().size(), 1u);
    world.broadphase.set_role(first, Role::fixed_interactive);
    world.remove(first);
    EXPECT_EQ(world.add(ball({50, 0, 0}, 1, {0, 0, 0})), first);
    const ProxyRecord &record = world.broadphase.proxies().records[first];
    EXPECT_EQ(record.role, Role::environment);
    EXPECT_EQ(record.size, 0) << "nothing is known of the new object yet";
    EXPECT_TRUE(world.tick().empty()) << "the new object is not in the pair of the old one";
    world.place(second, {51, 0, 0});
    EXPECT_EQ(world.tick().size(), 1u);
}

// Once, stale near pairs were removed only at a report, so without reports they accumulated.
TEST(BroadphaseMemory, StaysFlatInAProgramWithoutReports)
{
    World world;
    for (int i = 0; i < 20; ++i)
        world.add(ball({0.15 * i, 0, 0}, 0.1, {0, 0, 0}));
    auto ask = [&](int ticks) {
        for (int tick = 0; tick < ticks; ++tick)
        {
            for (ProxyId id : world.members())
                world.place(id, {0.15 * id, 0.02 * (tick % 3), 0});
            world.broadphase.catch_up(world);
        }
    };
    ask(3000);
    const std::size_t before = world.broadphase.bytes();
    ask(30000);
    EXPECT_LE(world.broadphase.bytes(), before + before / 2);
    EXPECT_LE(world.broadphase.near_pairs(), 200u);
}

// Each leap goes farther than any object has been, where single precision cannot resolve small gaps.
TEST(Broadphase, ObjectsThatLeapFarAwayAreTestedExactly)
{
    constexpr int pairs = 40;
    for (bool endless : {false, true})
    {
        Random random(7);
        World world;
        if (endless)
        {
            PredictionSettings settings;
            settings.deviation = {Deviation{infinity, 0, 0}, Deviation{infinity, 0, 0}};
            world.broadphase.set_settings(settings);
        }
        for (int i = 0; i < 2 * pairs; ++i)
            world.add(box(random.vector(10), Vector3::Constant(0.5), Vector3::Zero(), false));
        int apart = 0;
        for (double far = 10; far < 1e12; far *= 3)
        {
            for (ProxyId id = 0; id < 2 * pairs; id += 2)
            {
                const Vector3 centre = random.vector(far);
                const double gap = random.uniform(-1, 1) * 1e-6 * far;
                world.place(id, centre);
                world.place(id + 1, centre + Vector3(1 + gap, 0, 0));
                apart += gap > 0;
            }
            ASSERT_EQ(sorted_pairs(world.tick()), sorted_pairs(world.overlapping())) << far;
        }
        EXPECT_GT(apart, pairs);
    }
}

TEST(Broadphase, TimesAreForAsLongAsBothForecastsHold)
{
    const auto forecast = [](double x, double speed, double ticks) {
        Forecast made{};
        made.envelope.path = {Vector3(x, 0, 0), Vector3(speed, 0, 0), Vector3::Zero()};
        made.envelope.low = Vector3::Constant(-0.5);
        made.envelope.high = Vector3::Constant(0.5);
        made.envelope.radius = 1;
        made.ticks = ticks;
        return made;
    };
    const Broadphase broadphase{};
    for (double ticks : {10.0, 49.0, 51.0, 1000.0})
    {
        const Forecast brief = forecast(0, 0.1, ticks), lasting = forecast(6, 0, 100);
        const std::optional<double> time = broadphase.time_of_proximity(brief, lasting, false);
        EXPECT_EQ(time, broadphase.time_of_proximity(lasting, brief, false));
        EXPECT_EQ(time.has_value(), ticks > 50) << ticks;
        EXPECT_NEAR(time.value_or(50), 50, 1e-6);
    }
}
} // namespace
} // namespace ode_predictive_space
