// Times at which two geoms meet that move on parabolas and turn constantly: each answer is compared with the meeting.

#include <functional>
#include <limits>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
struct Answer
{
    int meets;
    dReal ticks;

    bool operator==(const Answer &other) const { return meets == other.meets && ticks == other.ticks; }
};
constexpr Answer not_known{0, 0};

std::ostream &operator<<(std::ostream &out, const Answer &answer)
{
    return out << "(" << answer.meets << ", " << answer.ticks << ")";
}

class Times : public OdeTest
{
protected:
    void fill(int others)
    {
        for (int i = 0; i < others; ++i)
            scene.sphere(0.1, 50 + i, 0, 0);
    }

    Answer ask(dGeomID one, dGeomID other) const
    {
        Answer answer{-1, -1};
        answer.meets = dPredictiveSpaceGetTimeOfProximity(space, one, other, &answer.ticks);
        return answer;
    }

    // Moves, collides and queries until the two meet. @return one answer for each tick from the tick `from` on.
    std::vector<Answer> answers_until_they_meet(dGeomID one, dGeomID other, int from,
                                                const std::function<void(int)> &move)
    {
        std::vector<Answer> answers;
        const Pair pair = std::minmax(geom_number(one), geom_number(other));
        for (int tick = 0; tick < 2000; ++tick)
        {
            move(tick);
            for (const Pair &met : unordered(collide(space)))
                if (met == pair)
                    return answers;
            if (tick < from)
                continue;
            answers.push_back(ask(one, other));
            EXPECT_EQ(ask(one, other), answers.back()) << "asked again in tick " << tick;
        }
        ADD_FAILURE() << "they do not meet";
        return {};
    }

    // The first two answers are unknown, later ones are not late, and the last of these are not much too early.
    // @param early in ticks; turning counts as if it moved the farthest corner straight on.
    static void expect_honest(const std::vector<Answer> &answers, dReal part = REAL(0.7), dReal early = 9)
    {
        ASSERT_GT(answers.size(), 20u);
        EXPECT_EQ(answers.back().meets, 1);
        EXPECT_EQ(answers[0], not_known);
        EXPECT_EQ(answers[1], not_known);
        for (std::size_t i = 2; i < answers.size(); ++i)
        {
            const auto until = static_cast<dReal>(answers.size() - i);
            EXPECT_LE(answers[i].ticks, until) << i;
            EXPECT_TRUE(answers[i].ticks > 0 || answers[i].meets || i == 2)
                << i << ": the third tick of a space that predicts";
            if (answers[i].meets && until < 30)
            {
                EXPECT_GE(answers[i].ticks, part * until - early) << i;
            }
        }
    }

    Scenario scene{SpaceKind::predictive, Asked::nothing};
    dSpaceID space = scene.space();
};

TEST_F(Times, OfAGeomThatTheProgramMovesAreNeverLate)
{
    const dReal speeds[] = {REAL(0.01), REAL(0.02), REAL(0.05)};
    for (int others : {0, 30, 300})
        for (int axis = 0; axis < 3; ++axis)
        {
            const auto put = [&](dGeomID geom, dReal way) {
                dGeomSetPosition(geom, axis == 0 ? way : 0, axis == 1 ? way : 0, axis == 2 ? way : 0);
            };
            fill(others);
            const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 0, 0, 0);
            put(other, 3);
            expect_honest(answers_until_they_meet(
                one, other, 10, [&](int tick) { put(one, speeds[axis] * static_cast<dReal>(tick)); }));
            dGeomDestroy(one);
            dGeomDestroy(other);
        }
}

// The turning of the first tick is less than any slack.
TEST_F(Times, CountAllTurningUntilTheMeeting)
{
    fill(20);
    const dGeomID one = scene.numbered(dCreateBox(space, 2, 0.02, 0.02)), other = scene.sphere(0.05, 0, 0.5, 0);
    expect_honest(answers_until_they_meet(one, other, 0,
                                          [&](int tick) {
                                              dMatrix3 R;
                                              dRFromAxisAndAngle(R, 0, 0, 1, REAL(0.0005) * static_cast<dReal>(tick));
                                              dGeomSetRotation(one, R);
                                          }),
                  REAL(0.4), 60);
}

// The fast one is known for a shorter time than the slow one.
TEST_F(Times, AreKnownUpToTheEarlierOfTwoEnds)
{
    fill(20);
    const dGeomID slow = scene.sphere(0.5, 0, 0, 0), fast = scene.sphere(0.5, 30, 0, 0);
    const std::vector<Answer> answers = answers_until_they_meet(slow, fast, 0, [&](int tick) {
        dGeomSetPosition(slow, REAL(0.001) * static_cast<dReal>(tick), 0, 0);
        dGeomSetPosition(fast, 30 - REAL(0.1) * static_cast<dReal>(tick), 0, 0);
    });
    expect_honest(answers);
    EXPECT_EQ(answers[2].meets, 0);
    EXPECT_GT(answers[2].ticks, 50);
    EXPECT_LT(answers[2].ticks, 100) << "the fast one needs so long for nine of its sizes";
}

TEST_F(Times, AreKnownForNoLessAndNoMoreThanTheHorizonAllows)
{
    fill(20);
    const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 0, 500, 0);
    const auto ask_later = [&] {
        for (int tick = 0; tick < 10; ++tick)
        {
            dGeomSetPosition(one, REAL(0.01) * static_cast<dReal>(tick), 0, 0);
            collide(space);
            ask(one, other);
        }
        return ask(one, other);
    };
    EXPECT_NEAR(ask_later().ticks, 180, 1) << "nine of its sizes";
    dPredictiveSpaceSetHorizon(space, 1000, 2000);
    EXPECT_EQ(ask_later(), (Answer{0, 1000}));
    dPredictiveSpaceSetHorizon(space, 1, 50);
    EXPECT_EQ(ask_later(), (Answer{0, 50}));
}

// The positions are rounded to a thousandth of a step, which bends the path through three of them.
TEST_F(Times, FarAwayAllowForTheRoundingOfPositions)
{
    const dReal far = REAL(1e-5) / std::numeric_limits<dReal>::epsilon();
    const dGeomID one = scene.sphere(0.1, far, 0, 0), other = scene.sphere(0.1, far + 3, 0, 0);
    EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
    for (int i = 0; i < 2; ++i)
        collide(space); // brings the origin near them
    expect_honest(answers_until_they_meet(
        one, other, 10, [&](int tick) { dGeomSetPosition(one, far + REAL(0.01) * static_cast<dReal>(tick), 0, 0); }));
}

TEST_F(Times, AreNotKnownAfterABounceUntilItsThirdTick)
{
    fill(20);
    const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 5, 0, 0);
    const dBodyID body = scene.body(one, -1, 0, 0);
    const auto tick = [&] {
        scene.step(0.01);
        collide(space);
        return ask(one, other);
    };
    for (int i = 0; i < 10; ++i)
        tick();
    EXPECT_EQ(ask(one, other).meets, 0);
    dBodySetLinearVel(body, 10, 0, 0);
    EXPECT_EQ(tick(), not_known);
    EXPECT_EQ(tick(), not_known);
    const Answer known = tick();
    EXPECT_GT(known.ticks, 1);
    EXPECT_LE(known.ticks, (5 - REAL(0.2) - dGeomGetPosition(one)[0]) / REAL(0.1));
}

TEST_F(Times, OfGeomsThatRestAreKnownFromTheThirdTickOn)
{
    fill(20);
    const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 5, 0, 0),
                  marker = scene.sphere(1, 500, 0, 0);
    const Answer never{0, dInfinity};
    for (int i = 0; i < 10; ++i)
    {
        dGeomSetPosition(marker, 500 + i, 0, 0);
        collide(space);
        EXPECT_EQ(ask(one, other), i < 2 ? not_known : never) << i;
    }
    dGeomSetPosition(one, 1, 0, 0);
    EXPECT_EQ(ask(one, other), not_known);
}

// Without motion no time passes.
TEST_F(Times, AreKnownWhenNothingMoves)
{
    const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 5, 0, 0);
    for (int i = 0; i <= 8; ++i)
    {
        collide(space);
        EXPECT_EQ(ask(one, other), i < 8 ? not_known : (Answer{0, dInfinity})) << i;
    }
}

// Between the step and the collide, the geoms are already in the places of the next tick.
TEST_F(Times, AreTheSameWhetherAskedBeforeOrAfterTheCollide)
{
    const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 3, 0, 0);
    int known = 0;
    for (int tick = 0; tick < 200; ++tick)
    {
        dGeomSetPosition(one, REAL(0.01) * static_cast<dReal>(tick), 0, 0);
        Answer before{};
        if (tick % 3 > 0)
            before = ask(one, other);
        collide(space);
        const Answer after = ask(one, other);
        if (tick % 3 > 0)
        {
            EXPECT_EQ(before, after) << tick;
        }
        known += after.ticks > 0;
    }
    EXPECT_GT(known, 190);
}

// A series of queries counts as a tick, but here a tick ends each series.
TEST_F(Times, CountTicksWhateverIsAskedWithinThem)
{
    fill(60);
    const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 3, 0, 0),
                  probe = dCreateSphere(nullptr, REAL(0.1));
    dGeomSetPosition(probe, 0, 0, 50);
    expect_honest(answers_until_they_meet(one, other, 10, [&](int tick) {
        const dReal way = REAL(0.01) * static_cast<dReal>(tick);
        dGeomSetPosition(one, way - REAL(0.005), 0, 0);
        EXPECT_TRUE(collide2(probe, as_geom(space)).empty());
        dGeomSetPosition(one, way, 0, 0);
    }));
    dGeomDestroy(probe);
}

TEST_F(Times, AreNotThoseOfAnotherGeomThatIsAskedAboutAfterOneHasComeToRest)
{
    fill(20);
    const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 3, 0, 0);
    const dGeomID first = scene.sphere(0.1, 0, 50, 0), last = scene.sphere(0.1, 0, 80, 0);
    expect_honest(answers_until_they_meet(one, other, 10, [&](int tick) {
        const dReal way = REAL(0.01) * static_cast<dReal>(tick);
        dGeomSetPosition(one, way, 0, 0);
        dGeomSetPosition(first, std::min(way, REAL(0.2)), 50, 0);
        dGeomSetPosition(last, 0, 80 + way, 0);
        ask(tick < 60 ? first : last, other);
    }));
}

TEST_F(Times, OfANewGeomAreNotThoseOfTheOneBefore)
{
    fill(20);
    const dGeomID other = scene.sphere(0.1, 3, 0, 0);
    dGeomID one = scene.sphere(0.1, 0, 0, 0);
    for (int tick = 0; tick < 40; ++tick)
    {
        if (tick == 20)
        {
            dGeomDestroy(one);
            one = scene.sphere(0.1, 0, 0, 0);
        }
        dGeomSetPosition(one, REAL(0.01) * static_cast<dReal>(tick), 0, 0);
        collide(space);
        const Answer answer = ask(one, other);
        if (tick % 20 < 2)
        {
            EXPECT_EQ(answer, not_known) << tick;
        }
        EXPECT_TRUE(tick % 20 < 5 || answer.ticks > 0) << tick;
    }
}

// The callback is called for pairs within the margin.
TEST_F(Times, OfShapesLastUntilTheMargin)
{
    dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
    for (const dReal margin : {REAL(0.0), REAL(0.5), REAL(1.0)})
    {
        dPredictiveSpaceSetShapeMargin(space, margin);
        const dGeomID one = scene.sphere(1, 0, 0, 0), other = scene.sphere(1, 5, 5, 5);
        dPredictiveSpaceSetGeomRole(space, one,
                                    dPredictiveRoleInteractive); // makes shapes decide about the callback, too
        fill(20);
        expect_honest(answers_until_they_meet(one, other, 10, [&](int tick) {
            const dReal place = 5 - REAL(0.02) * static_cast<dReal>(tick);
            dGeomSetPosition(other, place, place, place);
        }));
        dGeomDestroy(one);
        dGeomDestroy(other);
    }
}

TEST_F(Times, BySphereLastUntilTheSpheresMeet)
{
    dPredictiveSpaceSetProximity(space, dPredictiveProximitySphere);
    fill(20);
    const dGeomID one = scene.sphere(2, 0, 0, 0), other = scene.sphere(2, 9, 9, 9);
    expect_honest(answers_until_they_meet(one, other, 10, [&](int tick) {
        const dReal place = 9 - REAL(0.02) * static_cast<dReal>(tick);
        dGeomSetPosition(other, place, place, place);
    }));
}

// Their callbacks do not wait for the spheres.
TEST_F(Times, BySphereOfPairsThatOnlyBoxesCanJudgeAreThoseOfTheirBoxes)
{
    dPredictiveSpaceSetProximity(space, dPredictiveProximitySphere);
    fill(20);
    const dGeomID one = scene.numbered(dCreateCylinder(space, 1, 2)),
                  other = scene.numbered(dCreateCylinder(space, 1, 2));
    const dBodyID body = scene.body(other, 5, 5, 5);
    scene.body(one, 0, 0, 0);
    expect_honest(answers_until_they_meet(one, other, 10, [&](int tick) {
        const dReal place = 5 - REAL(0.02) * static_cast<dReal>(tick);
        dBodySetPosition(body, place, place, place);
    }));
}

// The forecast's sphere is around the geom, which is far from its body.
TEST_F(Times, OfAGeomWithAnOffsetAreThoseOfItself)
{
    for (const int proximity : {dPredictiveProximitySphere, dPredictiveProximityShape})
    {
        dPredictiveSpaceSetProximity(space, proximity);
        const dGeomID one = scene.sphere(0.5, 0, 0, 0), other = scene.sphere(0.5, 0, 0, 0);
        const dBodyID body = scene.body(other, 0, 0, 0);
        dGeomSetOffsetPosition(other, -8, -8, 0);
        dPredictiveSpaceSetGeomRole(space, one, dPredictiveRoleInteractive); // makes shapes decide about the callback
        fill(20);
        expect_honest(answers_until_they_meet(one, other, 10, [&](int tick) {
            const dReal place = 14 - REAL(0.05) * static_cast<dReal>(tick);
            dBodySetPosition(body, place, place, 0);
        }));
        dGeomDestroy(one);
        dGeomDestroy(other);
    }
}

// They have no position with a known motion.
TEST_F(Times, OfASphereThatCirclesAroundItsBodyAreNeverLate)
{
    fill(20);
    const dGeomID one = scene.sphere(0.1, 0, 0, 0), other = scene.sphere(0.1, 0, 1, 0);
    const dBodyID body = scene.body(one, 0, 0, 0);
    dGeomSetOffsetPosition(one, 1, 0, 0);
    expect_honest(answers_until_they_meet(one, other, 0,
                                          [&](int tick) {
                                              dMatrix3 R;
                                              dRFromAxisAndAngle(R, 0, 0, 1, REAL(0.005) * static_cast<dReal>(tick));
                                              dBodySetRotation(body, R);
                                          }),
                  REAL(0.4), 60);
}

// Its own path is no parabola.
TEST_F(Times, OfAGeomAtAnOffsetAreKnownHoweverFastItsBodyTurns)
{
    fill(20);
    const dGeomID one = scene.box(REAL(0.1), 0, 0, 0), other = scene.sphere(REAL(0.1), 4, 0, 0);
    const dBodyID body = scene.body(one, 0, 0, 0);
    dGeomSetOffsetPosition(one, 1, 0, 0);
    for (int tick = 0; tick < 20; ++tick)
    {
        dMatrix3 R;
        dRFromAxisAndAngle(R, 0, 0, 1, REAL(0.2) * static_cast<dReal>(tick));
        dBodySetRotation(body, R);
        collide(space);
        const Answer answer = ask(one, other);
        EXPECT_TRUE(tick < 3 || answer.ticks > 100) << answer;
    }
}

TEST_F(Times, OfPlanesAndSpacesThatMoveAreNotKnown)
{
    fill(20);
    const dGeomID ball = scene.sphere(0.1, 0, 0, 0), plane = dCreatePlane(space, 0, 0, 1, -5);
    const dSpaceID inner = dSimpleSpaceCreate(space);
    const dGeomID member = dCreateSphere(inner, REAL(0.1));
    for (int tick = 0; tick < 40; ++tick)
    {
        const dReal way = REAL(0.1) * static_cast<dReal>(tick);
        dGeomPlaneSetParams(plane, 0, 0, 1, way - 5);
        dGeomSetPosition(member, 5 - way, 0, 0);
        collide(space);
        EXPECT_EQ(ask(ball, plane), not_known) << tick;
        EXPECT_EQ(ask(ball, as_geom(inner)), not_known) << tick;
    }
}

// This holds for shapes, too, and the still box is known for longer than the ball.
TEST_F(Times, DoNotDependOnWhoIsAskedAboutFirst)
{
    for (const int proximity : {dPredictiveProximityBox, dPredictiveProximitySphere, dPredictiveProximityShape})
    {
        dPredictiveSpaceSetProximity(space, proximity);
        const dGeomID box = scene.box(10, 0, 0, 0), ball = scene.sphere(0.1, 8, 8, 0);
        dMatrix3 turned;
        dRFromAxisAndAngle(turned, 0, 0, 1, REAL(M_PI_4));
        dGeomSetRotation(box, turned);
        fill(20);
        for (int tick = 0; tick < 20; ++tick)
        {
            const dReal place = 8 - REAL(0.02) * static_cast<dReal>(tick);
            dGeomSetPosition(ball, place, place, 0);
            collide(space);
            EXPECT_EQ(ask(box, ball), ask(ball, box)) << proximity << " " << tick;
        }
        dGeomDestroy(box);
        dGeomDestroy(ball);
    }
}
} // namespace
} // namespace ode_predictive_space
