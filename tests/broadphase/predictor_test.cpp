#include "ode_predictive_space/broadphase/predict/predictor.h"

#include <array>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/tracked.h"

namespace ode_predictive_space
{
namespace
{
constexpr double step = 0.001;
constexpr double radius = 0.1;

// A ball that a body carries, moved as ODE moves it: with the velocity that it has at the end of the step.
struct MovingBall
{
    Vector3 centre = Vector3::Zero();
    Vector3 velocity = Vector3::Zero();
    Vector3 gravity = Vector3::Zero();

    Observation next()
    {
        velocity += step * gravity;
        centre += step * velocity;
        return seen_ball(centre, radius, velocity);
    }
};

void follow(Tracked &tracked, MovingBall &object, int ticks)
{
    for (int tick = 0; tick < ticks; ++tick)
    {
        tracked.see(object.next());
        ASSERT_TRUE(tracked.inside(seen_ball(object.centre, radius, object.velocity))) << "tick " << tick;
    }
}

TEST(Predictor, AfterABreakUniformMotionIsPredictedForLongerAndLonger)
{
    Predictor predictor;
    Tracked tracked(predictor);
    MovingBall object;
    object.velocity = {0.3, -0.1, 0.2};
    for (int tick = 0; tick < 140; ++tick, object.velocity *= tick % 50 == 0 ? -1 : 1)
        tracked.see(object.next());
    const std::int32_t early = ticks_between(tracked.path().since, tracked.record().prediction.until);
    follow(tracked, object, 2000);
    const std::int32_t late = ticks_between(tracked.path().since, tracked.record().prediction.until);
    EXPECT_GT(late, 2 * early);
    const int before = tracked.predictions, violated = tracked.violations;
    follow(tracked, object, 2000);
    EXPECT_LT(tracked.predictions - before, 2000 / 50);
    EXPECT_EQ(tracked.violations, violated) << "nothing breaks in uniform motion";
    EXPECT_NEAR(predictor.step_estimate.step(), step, 1e-9);
}

TEST(Predictor, ItsFirstPredictionLastsLong)
{
    Predictor predictor;
    Tracked first(predictor), tracked(predictor);
    MovingBall object;
    object.velocity = {0.03, 0, 0};
    follow(first, object, 100);
    tracked.see(object.next());
    EXPECT_GE(tracked.store.remaining(0, tracked.now), 1024 / 8);
    predictor.settings.horizon.max_ticks = 80;
    Tracked bounded(predictor);
    bounded.see(object.next());
    EXPECT_LE(bounded.store.remaining(0, bounded.now), 80);
}

// A swept box across the whole room would meet everything.
TEST(Predictor, ALeapIsNotExtrapolated)
{
    Predictor predictor;
    Tracked tracked(predictor);
    for (int tick = 0; tick < 20; ++tick)
    {
        tracked.see(seen_alone(Vector3::Constant(10 * std::sin(tick * tick)), 0.1));
        const FloatBox box = tracked.store.swept_box(0, tracked.now);
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_LT(box.high[axis] - box.low[axis], 1) << "tick " << tick;
    }
}

TEST(Predictor, AnObjectThatHasStoppedNeedsNoPredictions)
{
    Predictor predictor;
    Tracked tracked(predictor);
    MovingBall object;
    object.velocity = {1, 0, 0};
    follow(tracked, object, 300);
    object.velocity = {0, 0, 0};
    follow(tracked, object, 500);
    EXPECT_TRUE(tracked.record().kind.still);
    const int before = tracked.predictions;
    for (int tick = 0; tick < 10000; ++tick)
    {
        ++tracked.now;
        ASSERT_TRUE(tracked.inside(seen_ball(object.centre, radius, object.velocity)));
    }
    EXPECT_EQ(tracked.predictions, before);
}

TEST(Predictor, AnObjectThatNeverMovedHasNoSlack)
{
    Predictor predictor;
    Tracked tracked(predictor);
    tracked.see(seen_alone({1, 2, 3}, radius));
    EXPECT_TRUE(tracked.record().kind.still);
    EXPECT_EQ(tracked.path().deviation_base, 0);
    EXPECT_EQ(tracked.record().role, Role::environment);
}

TEST(Predictor, ABounceBreaksOnePredictionOrTwo)
{
    Predictor predictor;
    Tracked tracked(predictor);
    MovingBall object;
    object.velocity = {1, 0, -1};
    follow(tracked, object, 500);
    for (int bounce = 0; bounce < 20; ++bounce)
    {
        const int before = tracked.violations;
        object.velocity.z() = -object.velocity.z();
        follow(tracked, object, 300);
        EXPECT_LE(tracked.violations - before, 2) << "bounce " << bounce;
        EXPECT_NEAR(predictor.step_estimate.step(), step, 0.01 * step) << "a bounce says nothing about the step";
    }
}

TEST(Predictor, FreeFallIsPredicted)
{
    Predictor predictor;
    Tracked tracked(predictor);
    MovingBall object;
    object.velocity = {1, 0, 5};
    object.gravity = {0, 0, -9.81};
    follow(tracked, object, 50);
    const int predictions = tracked.predictions, violations = tracked.violations;
    follow(tracked, object, 950);
    EXPECT_LT(tracked.predictions - predictions, 950 / 20);
    EXPECT_LE(tracked.violations - violations, 2);
    EXPECT_NEAR(predictor.step_estimate.step(), step, 0.01 * step);
}

TEST(Predictor, ResultsDoNotDependOnTheUnitOfTime)
{
    for (double unit : {1e-4, 1.0, 1e4})
    {
        Predictor predictor;
        Tracked tracked(predictor);
        Vector3 centre = Vector3::Zero();
        for (int tick = 0; tick < 2000; ++tick)
        {
            centre += Vector3(0.0004, 0, 0);
            tracked.see(seen_ball(centre, radius, Vector3(0.0004, 0, 0) / unit));
        }
        EXPECT_NEAR(predictor.step_estimate.step() / unit, 1, 1e-6);
        EXPECT_LT(tracked.predictions, 60);
    }
}

TEST(Predictor, JitterEndsInSlack)
{
    Random random(1);
    Predictor predictor;
    Tracked tracked(predictor);
    auto jitter = [&](int ticks) {
        for (int tick = 0; tick < ticks; ++tick)
            tracked.see(seen_ball(random.vector(1e-4 * radius), radius, random.vector(0.01 * radius)));
    };
    jitter(500);
    EXPECT_TRUE(tracked.record().kind.still);
    EXPECT_GT(tracked.path().deviation_base, 0);
    const int before = tracked.predictions;
    jitter(5000);
    EXPECT_EQ(tracked.predictions, before);
}

TEST(Predictor, AVelocityThatExplainsNothingIsNotTrustedForLong)
{
    Predictor predictor;
    Tracked other(predictor), tracked(predictor);
    MovingBall honest;
    honest.velocity = {1, 0, 0};
    Vector3 centre = Vector3::Zero();
    auto run = [&](int ticks) {
        for (int tick = 0; tick < ticks; ++tick)
        {
            other.see(honest.next());
            centre += Vector3(0, 0.0005, 0);
            // Moved by the program while its body claims to fly elsewhere.
            tracked.see(seen_ball(centre, radius, {-3, 0, 0}));
        }
    };
    run(300);
    const int before = tracked.predictions;
    run(2000);
    EXPECT_LT(tracked.predictions - before, 2000 / 10);
    EXPECT_NEAR(predictor.step_estimate.step(), step, 0.05 * step);
}

// In a pile velocities are noise. As long as predictions hold nevertheless, none of them is a guess for one tick.
TEST(Predictor, AVelocityThatExplainsLittleIsNotMistrustedWhilePredictionsHold)
{
    Predictor predictor;
    Tracked other(predictor), tracked(predictor);
    MovingBall honest;
    honest.velocity = {1, 0, 0};
    Random random(1);
    Vector3 centre = Vector3::Zero();
    int guesses = 0;
    for (int tick = 0; tick < 40000; ++tick)
    {
        other.see(honest.next());
        centre += random.vector(4e-5);
        const int violations = tracked.violations, predictions = tracked.predictions;
        tracked.see(seen_ball(centre, radius, random.vector(0.02)));
        const bool kept = tracked.violations == violations, anew = tracked.predictions > predictions;
        guesses += tick > 100 && kept && anew && tracked.store.remaining(0, tracked.now) == 1;
    }
    EXPECT_EQ(guesses, 0);
    EXPECT_GT(tracked.predictions, 50) << "the object does move";
}

// Reaches of minimum jerk between random points, with a tremor.
Vector3 hand(Random &random, int tick, Vector3 &from, Vector3 &to)
{
    constexpr int reach = 700;
    if (tick % reach == 0)
    {
        from = to;
        to = random.vector(0.3);
    }
    const double s = static_cast<double>(tick % reach) / reach;
    const double progress = s * s * s * (10 - 15 * s + 6 * s * s);
    return from + progress * (to - from) + Vector3::Constant(5e-5 * std::sin(0.06 * tick));
}

TEST(Predictor, AHandIsRecognisedAndPredictedFromItsPositions)
{
    Random random(2);
    Predictor predictor;
    Tracked tracked(predictor);
    Vector3 from = Vector3::Zero(), to = Vector3::Zero();
    constexpr int ticks = 20000;
    for (int tick = 0; tick < ticks; ++tick)
    {
        const Observation seen = seen_alone(hand(random, tick, from, to), 0.02);
        tracked.see(seen);
        ASSERT_TRUE(tracked.inside(seen));
    }
    EXPECT_EQ(tracked.record().role, Role::interactive);
    EXPECT_LT(tracked.predictions, ticks / 4);
    EXPECT_LT(tracked.violations, ticks / 6);
    EXPECT_EQ(predictor.step_estimate.step(), 0) << "a hand tells no velocity";
}

TEST(Predictor, AFixedRoleStays)
{
    Predictor predictor;
    Tracked tracked(predictor);
    tracked.store.records[0].role = Role::fixed_environment;
    for (int tick = 0; tick < 100; ++tick)
        tracked.see(seen_alone({0.01 * tick, 0, 0}, radius));
    EXPECT_EQ(tracked.record().role, Role::fixed_environment);
}

TEST(Predictor, AFixedDeviationIsThatOfTheRole)
{
    Predictor predictor;
    predictor.settings.deviation[0] = Deviation{0.5, 0.25, 0.125};
    predictor.settings.deviation[1] = Deviation{0.0625, 0.03125, 0};
    for (Role role : {Role::fixed_environment, Role::fixed_interactive})
    {
        const Deviation expected = *predictor.settings.deviation[is_interactive(role) ? 1 : 0];
        Tracked moving(predictor), still(predictor);
        moving.store.records[0].role = still.store.records[0].role = role;
        for (int tick = 0; tick < 50; ++tick)
        {
            moving.see(seen_ball({0.5 * tick, 0, 0}, radius, {500, 0, 0}));
            still.see(seen_alone({1, 2, 3}, radius));
        }
        ASSERT_FALSE(moving.record().kind.still);
        EXPECT_EQ(moving.path().deviation().a, expected.a);
        EXPECT_EQ(moving.path().deviation().b, expected.b);
        EXPECT_EQ(moving.path().deviation().c, expected.c);
        ASSERT_TRUE(still.record().kind.still);
        EXPECT_EQ(still.path().deviation().a, expected.a);
        EXPECT_EQ(still.path().deviation().b, 0) << "a still object does not become less certain";
    }
}

TEST(Predictor, HorizonsKeepToTheirBounds)
{
    for (const HorizonBounds &horizon : {HorizonBounds{1, 1}, HorizonBounds{3, 7}, HorizonBounds{20, 4000},
                                         HorizonBounds{50, 50}, HorizonBounds{1, 0x7fffffff}})
    {
        Random random(3);
        Predictor predictor;
        predictor.settings.horizon = horizon;
        Tracked tracked(predictor);
        MovingBall object;
        for (int tick = 0; tick < 5000; ++tick)
        {
            if (random.chance(0.01))
                object.velocity = random.vector(random.chance(0.5) ? 0.05 : 5);
            tracked.see(object.next());
            if (tracked.record().kind.still)
                continue;
            const std::int32_t ticks = ticks_between(tracked.path().since, tracked.record().prediction.until);
            ASSERT_GE(ticks, static_cast<std::int32_t>(horizon.min_ticks));
            ASSERT_LE(ticks, static_cast<std::int32_t>(horizon.max_ticks));
        }
    }
}

TEST(Predictor, HorizonsOfEqualObjectsDiffer)
{
    Predictor predictor;
    ProxyStore store;
    std::vector<Tick> ends;
    for (ProxyId id = 0; id < 100; ++id)
        store.add();
    predictor.resize(store.size());
    for (Tick tick = 0; tick <= 200; tick += 20)
        for (ProxyId id = 0; id < 100; ++id)
            predictor.predict(store, id, seen_ball({0.0005 * tick, 0, 0}, radius, {0.5, 0, 0}), tick);
    for (const ProxyRecord &record : store.records)
        ends.push_back(record.prediction.until);
    std::sort(ends.begin(), ends.end());
    int together = 0;
    for (Tick end : ends)
        together = std::max(together, static_cast<int>(std::count(ends.begin(), ends.end(), end)));
    EXPECT_LT(together, 30);
}

TEST(Predictor, CrowdedObjectsLookLessFarAhead)
{
    Predictor predictor;
    Tracked alone(predictor), crowded(predictor);
    MovingBall one, other;
    one.velocity = other.velocity = {0.5, 0, 0};
    for (int tick = 0; tick < 3000; ++tick)
    {
        crowded.store.records[0].kind.crowded = true;
        alone.see(one.next());
        crowded.see(other.next());
    }
    EXPECT_GT(crowded.predictions, alone.predictions);
}

TEST(Predictor, NotANumberHarmsNoOtherObject)
{
    Predictor predictor;
    Tracked tracked(predictor), lost(predictor);
    MovingBall object;
    object.velocity = {0.5, 0, 0};
    follow(tracked, object, 200);
    for (const Vector3 &bad :
         {Vector3(nan, 0, 0), Vector3(infinity, 0, 0), Vector3(0, -infinity, nan), Vector3(1e300, 0, 0)})
    {
        Observation seen = seen_ball(bad, radius, bad);
        seen.bounds = Box(bad.array() - radius, bad.array() + radius);
        for (int tick = 0; tick < 10; ++tick)
            lost.see(seen);
    }
    EXPECT_NEAR(predictor.step_estimate.step(), step, 1e-9);
    const int before = tracked.predictions;
    follow(tracked, object, 1000);
    EXPECT_LT(tracked.predictions - before, 50);
    MovingBall found;
    found.velocity = {0.5, 0, 0};
    follow(lost, found, 1000);
    const int recovered = lost.predictions;
    follow(lost, found, 1000);
    EXPECT_LT(lost.predictions - recovered, 50) << "the object is back and is predicted like any other";
}

TEST(Predictor, AVelocityThatIsNotANumberIsNone)
{
    Predictor predictor;
    Tracked tracked(predictor);
    for (int tick = 0; tick < 100; ++tick)
        tracked.see(seen_ball({0, 0, 0}, radius, {nan, infinity, 1e40}));
    EXPECT_TRUE(tracked.record().kind.still);
    EXPECT_EQ(predictor.step_estimate.step(), 0);
}

TEST(Predictor, InfiniteBoundsAreStillAndKeepTheirFiniteSide)
{
    Predictor predictor;
    Tracked tracked(predictor);
    const Box half_space(Vector3::Constant(-infinity), Vector3(infinity, infinity, 1.5));
    tracked.see(seen_bounds(half_space));
    EXPECT_TRUE(tracked.record().kind.still);
    EXPECT_EQ(tracked.record().kind.check, Check::bounds);
    const Box envelope = tracked.store.envelope(0, tracked.now).at(0);
    EXPECT_EQ(envelope.min(), half_space.min());
    EXPECT_EQ(envelope.max().x(), infinity);
    EXPECT_GE(envelope.max().z(), 1.5);
    EXPECT_LT(envelope.max().z(), 1.5001);
}

// The next verification must accept what has just been predicted, whatever the numbers are.
TEST(Predictor, APredictionHoldsWhenItIsMade)
{
    Random random(4);
    for (int i = 0; i < 200000; ++i)
    {
        Predictor predictor;
        Tracked tracked(predictor);
        const double far = std::pow(10, random.uniform(-6, 12)), size = std::pow(10, random.uniform(-6, 6));
        const double exact = std::exp2(static_cast<double>(random.index(20)) - 10);
        const Vector3 low = random.vector(far);
        Observation seen = seen_bounds(Box(low, low + random.vector(size).cwiseAbs()));
        // Extents that are floats are not rounded outwards: they show what the rest of the arithmetic does.
        if (i % 4 == 1)
            seen = seen_bounds(Box(low.array() - exact, low.array() + exact));
        if (i % 2 == 0)
            seen = seen_ball(low, size, random.vector(far));
        tracked.predict(seen);
        ASSERT_TRUE(tracked.inside(seen)) << i;
        ASSERT_GE(tracked.record().prediction.radius, seen.bounds ? 0.5 * seen.bounds->diagonal().norm() : size);
        tracked.now += 1;
        tracked.predict(seen);
        ASSERT_TRUE(tracked.inside(seen)) << i;
    }
}

TEST(Predictor, EachPredictionIsAGenerationOfItsOwn)
{
    Predictor predictor;
    Tracked tracked(predictor);
    Generation last = tracked.store.generations[0];
    for (int i = 0; i < 10; ++i)
    {
        tracked.predict(seen_alone({0, 0, 0.1 * i}, radius));
        EXPECT_NE(tracked.store.generations[0], last);
        last = tracked.store.generations[0];
    }
}

TEST(Predictor, UsesTheMemoryOfForgottenObjectsAgain)
{
    Predictor predictor;
    auto live = [&] {
        Tracked tracked(predictor);
        for (int tick = 0; tick < 20; ++tick)
            tracked.see(seen_alone({0.01 * tick, 0, 0}, radius));
        ASSERT_NE(tracked.record().learned.history, no_history);
        predictor.forget(tracked.store, 0);
        EXPECT_EQ(tracked.record().learned.history, no_history);
    };
    live();
    const std::size_t before = predictor.bytes();
    EXPECT_GT(before, 0u);
    for (int life = 0; life < 1000; ++life)
        live();
    EXPECT_EQ(predictor.bytes(), before);
}
} // namespace
} // namespace ode_predictive_space
