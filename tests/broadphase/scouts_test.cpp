#include "ode_predictive_space/broadphase/scouts.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
// Objects on straight paths, some of which jump.
struct Flock
{
    std::vector<Vector3> centres;
    IdSet members;
    std::size_t jumping = 0;
    double arm = 0; // on which the middle of each goes round what it turns around
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

    Box bounds(ProxyId id) const
    {
        const Vector3 middle = centres[id] + arm * Vector3(std::sin(ticks), std::cos(ticks), 0);
        return Box(middle.array() - 0.5, middle.array() + 0.5);
    }
    Observation observe(ProxyId id, bool)
    {
        ++looks;
        Observation seen;
        seen.velocity = Vector3(10, 20, 0);
        if (arm != 0)
            seen.centre = centres[id];
        return seen;
    }

    bool seen_calm_by(Scouts &scouts) { return scouts.calm(*this, members, step); }

    StepEstimate step;
};

bool calm_after(Scouts &scouts, Flock &flock, int ticks)
{
    bool calm = false;
    for (int tick = 0; tick < ticks; ++tick)
    {
        flock.move();
        calm = flock.seen_calm_by(scouts);
    }
    return calm;
}

TEST(Scouts, AreCalmWhenTheFlockIs)
{
    for (std::size_t count : {1, 10, 31, 33, 64, 1000})
    {
        Flock flock(count);
        Scouts scouts;
        scouts.choose(flock.members);
        EXPECT_TRUE(calm_after(scouts, flock, 3)) << count;
    }
}

TEST(Scouts, LearnHowFarVelocitiesCarry)
{
    Flock flock(10);
    Scouts scouts;
    scouts.choose(flock.members);
    calm_after(scouts, flock, 3);
    EXPECT_NEAR(flock.step.step(), 0.01, 1e-12);
}

TEST(Scouts, LookAtWhatTheyTurnAround)
{
    Flock flock(10);
    flock.arm = 1;
    Scouts scouts;
    scouts.choose(flock.members);
    EXPECT_TRUE(calm_after(scouts, flock, 3));
    EXPECT_NEAR(flock.step.step(), 0.01, 1e-12);
}

TEST(Scouts, AreNotCalmBeforeTheyHaveSeenTheFlockMove)
{
    Flock flock(10);
    Scouts scouts;
    scouts.choose(flock.members);
    EXPECT_FALSE(calm_after(scouts, flock, 2));
    EXPECT_TRUE(calm_after(scouts, flock, 1));
}

TEST(Scouts, AreNotCalmWhenTheFlockJumps)
{
    for (std::size_t count : {1, 10, 31, 33, 64, 1000})
    {
        Flock flock(count);
        flock.jumping = 100;
        Scouts scouts;
        scouts.choose(flock.members);
        for (int tick = 0; tick < 20; ++tick)
            EXPECT_FALSE(calm_after(scouts, flock, 1)) << count;
    }
}

TEST(Scouts, StandForThePartOfTheFlockThatJumps)
{
    Flock flock(1000);
    Scouts scouts;
    scouts.choose(flock.members);
    flock.jumping = 60;
    EXPECT_FALSE(calm_after(scouts, flock, 4));
    flock.jumping = 0;
    EXPECT_TRUE(calm_after(scouts, flock, 3));
}

// Nobody keeps on at so many looks, nor at the next one: they have left their lines.
void disturb(Scouts &scouts, Flock &flock, int times)
{
    flock.jumping = 100;
    EXPECT_FALSE(calm_after(scouts, flock, times));
    flock.jumping = 0;
}

TEST(Scouts, RestWhenTheyWereDisturbedTimeAfterTimeAndThenLookAfresh)
{
    Flock flock(10);
    Scouts scouts;
    scouts.choose(flock.members);
    calm_after(scouts, flock, 2);
    disturb(scouts, flock, Scouts::patience);
    const int looks = flock.looks;
    EXPECT_FALSE(calm_after(scouts, flock, Scouts::rest));
    EXPECT_EQ(flock.looks, looks);
    flock.step = {};
    EXPECT_FALSE(calm_after(scouts, flock, 1));
    EXPECT_EQ(flock.step.step(), 0) << "the way that it went meanwhile is not that of a tick";
    EXPECT_FALSE(calm_after(scouts, flock, 1)) << "what was seen before the rest tells nothing";
    EXPECT_TRUE(calm_after(scouts, flock, 1));
    EXPECT_TRUE(calm_after(scouts, flock, 1));
}

TEST(Scouts, DoNotRestWhenTheyAreDisturbedNowAndThen)
{
    Flock flock(10);
    Scouts scouts;
    scouts.choose(flock.members);
    calm_after(scouts, flock, 3);
    for (int time = 0; time < 5; ++time)
    {
        disturb(scouts, flock, 1); // two ticks later they are on a line again
        EXPECT_TRUE(calm_after(scouts, flock, 3)) << time;
    }
}

TEST(Scouts, DoNotRestWhenTheyAreChosenAnew)
{
    Flock flock(10);
    Scouts scouts;
    scouts.choose(flock.members);
    calm_after(scouts, flock, 2);
    disturb(scouts, flock, Scouts::patience);
    scouts.choose(flock.members);
    EXPECT_TRUE(calm_after(scouts, flock, 3));
}

TEST(Scouts, AStillFlockIsCalm)
{
    Flock flock(50);
    Scouts scouts;
    scouts.choose(flock.members);
    for (int tick = 0; tick < 3; ++tick)
        flock.seen_calm_by(scouts);
    EXPECT_TRUE(flock.seen_calm_by(scouts));
}

TEST(Scouts, WhatIsNotANumberIsNotCalm)
{
    Flock flock(10);
    for (Vector3 &centre : flock.centres)
        centre.x() = std::numeric_limits<double>::quiet_NaN();
    Scouts scouts;
    scouts.choose(flock.members);
    EXPECT_FALSE(calm_after(scouts, flock, 5));
}

TEST(Scouts, ThatAreGoneAreNotAsked)
{
    Flock flock(10);
    Scouts scouts;
    scouts.choose(flock.members);
    for (ProxyId id = 0; id < 9; ++id)
    {
        flock.members.erase(id);
        flock.centres[id].x() = std::numeric_limits<double>::quiet_NaN();
    }
    EXPECT_TRUE(calm_after(scouts, flock, 3));
}
} // namespace
} // namespace ode_predictive_space
