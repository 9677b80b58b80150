#include "ode_predictive_space/broadphase/sweep/motion_sampler.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
namespace
{
// Objects on straight paths, some of which jump.
struct Flock : Scene
{
    std::vector<Vector3> centres;
    IdSet members;
    std::size_t jumping = 0;
    double arm = 0; // on which the middle of each circles around its centre
    int ticks = 0;
    int looks = 0; // at any of them

    explicit Flock(std::size_t count) : centres(count, Vector3::Zero())
    {
        members.resize(count);
        for (ProxyId id = 0; id < count; ++id)
            members.insert(id);
    }

    void move()
    {
        ++ticks;
        for (std::size_t i = 0; i < centres.size(); ++i)
            if (i % 100 < jumping)
                centres[i] = Vector3::Constant(5 * std::sin(1.0 * ticks * ticks));
            else
                centres[i] += Vector3(0.1, 0.2, 0);
    }

    Box bounds(ProxyId id) override
    {
        const Vector3 middle = centres[id] + arm * Vector3(std::sin(ticks), std::cos(ticks), 0);
        return Box(middle.array() - 0.5, middle.array() + 0.5);
    }

    void observe(const ProxyId *ids, std::size_t count, const bool *, Observation *seen) override
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            ++looks;
            seen[i] = Observation{};
            seen[i].velocity = Vector3(10, 20, 0);
            if (arm != 0)
                seen[i].centre = centres[ids[i]];
        }
    }

    // The sampler asks nothing else.
    void locate(const ProxyId *, std::size_t, Location *) override { ADD_FAILURE(); }
    void measure(const ProxyId *, std::size_t, MeasuredBox *) override { ADD_FAILURE(); }
    std::optional<Vector3> pivot(ProxyId) override { return std::nullopt; }
    bool overlap(ProxyId, ProxyId) override { return false; }
    void find_disabled(const ProxyId *, std::size_t, std::vector<ProxyId> &) override { ADD_FAILURE(); }

    bool seen_calm_by(MotionSampler &sampler) { return sampler.is_calm(*this, members, step); }

    StepEstimate step;
};

bool calm_after(MotionSampler &sampler, Flock &flock, int ticks)
{
    bool calm = false;
    for (int tick = 0; tick < ticks; ++tick)
    {
        flock.move();
        calm = flock.seen_calm_by(sampler);
    }
    return calm;
}

TEST(MotionSampler, IsCalmWhenTheFlockIs)
{
    for (std::size_t count : {1, 10, 31, 33, 64, 1000})
    {
        Flock flock(count);
        MotionSampler sampler;
        sampler.choose(flock.members);
        EXPECT_TRUE(calm_after(sampler, flock, 3)) << count;
    }
}

TEST(MotionSampler, LearnsHowFarVelocitiesCarry)
{
    Flock flock(10);
    MotionSampler sampler;
    sampler.choose(flock.members);
    calm_after(sampler, flock, 3);
    EXPECT_NEAR(flock.step.step(), 0.01, 1e-12);
}

TEST(MotionSampler, LooksAtThePointThatAnObjectTurnsAround)
{
    Flock flock(10);
    flock.arm = 1;
    MotionSampler sampler;
    sampler.choose(flock.members);
    EXPECT_TRUE(calm_after(sampler, flock, 3));
    EXPECT_NEAR(flock.step.step(), 0.01, 1e-12);
}

TEST(MotionSampler, IsNotCalmBeforeItHasSeenTheFlockMove)
{
    Flock flock(10);
    MotionSampler sampler;
    sampler.choose(flock.members);
    EXPECT_FALSE(calm_after(sampler, flock, 2));
    EXPECT_TRUE(calm_after(sampler, flock, 1));
}

TEST(MotionSampler, IsNotCalmWhenTheFlockJumps)
{
    for (std::size_t count : {1, 10, 31, 33, 64, 1000})
    {
        Flock flock(count);
        flock.jumping = 100;
        MotionSampler sampler;
        sampler.choose(flock.members);
        for (int tick = 0; tick < 20; ++tick)
            EXPECT_FALSE(calm_after(sampler, flock, 1)) << count;
    }
}

TEST(MotionSampler, RepresentsThePartOfTheFlockThatJumps)
{
    Flock flock(1000);
    MotionSampler sampler;
    sampler.choose(flock.members);
    flock.jumping = 60;
    EXPECT_FALSE(calm_after(sampler, flock, 4));
    flock.jumping = 0;
    EXPECT_TRUE(calm_after(sampler, flock, 3));
}

// No object keeps on at so many looks, nor at the next one: all have left their lines.
void disturb(MotionSampler &sampler, Flock &flock, int times)
{
    flock.jumping = 100;
    EXPECT_FALSE(calm_after(sampler, flock, times));
    flock.jumping = 0;
}

TEST(MotionSampler, PausesAfterDisturbedLooksAndThenStartsAfresh)
{
    Flock flock(10);
    MotionSampler sampler;
    sampler.choose(flock.members);
    calm_after(sampler, flock, 2);
    disturb(sampler, flock, tuning::disturbed_looks);
    const int looks = flock.looks;
    EXPECT_FALSE(calm_after(sampler, flock, tuning::pause_ticks));
    EXPECT_EQ(flock.looks, looks);
    flock.step = {};
    EXPECT_FALSE(calm_after(sampler, flock, 1));
    EXPECT_EQ(flock.step.step(), 0) << "the distance covered in the pause is not that of one tick";
    EXPECT_FALSE(calm_after(sampler, flock, 1)) << "positions from before the pause tell nothing";
    EXPECT_TRUE(calm_after(sampler, flock, 1));
    EXPECT_TRUE(calm_after(sampler, flock, 1));
}

TEST(MotionSampler, DoesNotPauseWhenDisturbedNowAndThen)
{
    Flock flock(10);
    MotionSampler sampler;
    sampler.choose(flock.members);
    calm_after(sampler, flock, 3);
    for (int time = 0; time < 5; ++time)
    {
        disturb(sampler, flock, 1); // two ticks later the objects are on a line again
        EXPECT_TRUE(calm_after(sampler, flock, 3)) << time;
    }
}

TEST(MotionSampler, DoesNotPauseWhenChosenAnew)
{
    Flock flock(10);
    MotionSampler sampler;
    sampler.choose(flock.members);
    calm_after(sampler, flock, 2);
    disturb(sampler, flock, tuning::disturbed_looks);
    sampler.choose(flock.members);
    EXPECT_TRUE(calm_after(sampler, flock, 3));
}

TEST(MotionSampler, AStillFlockIsCalm)
{
    Flock flock(50);
    MotionSampler sampler;
    sampler.choose(flock.members);
    for (int tick = 0; tick < 3; ++tick)
        flock.seen_calm_by(sampler);
    EXPECT_TRUE(flock.seen_calm_by(sampler));
}

TEST(MotionSampler, NotANumberIsNotCalm)
{
    Flock flock(10);
    for (Vector3 &centre : flock.centres)
        centre.x() = std::numeric_limits<double>::quiet_NaN();
    MotionSampler sampler;
    sampler.choose(flock.members);
    EXPECT_FALSE(calm_after(sampler, flock, 5));
}

TEST(MotionSampler, LooksAtNoObjectThatIsGone)
{
    Flock flock(10);
    MotionSampler sampler;
    sampler.choose(flock.members);
    for (ProxyId id = 0; id < 9; ++id)
    {
        flock.members.erase(id);
        flock.centres[id].x() = std::numeric_limits<double>::quiet_NaN();
    }
    EXPECT_TRUE(calm_after(sampler, flock, 3));
}
} // namespace
} // namespace ode_predictive_space
