#include "ode_predictive_space/recording/advice.h"

#include <gtest/gtest.h>

#include "ode_predictive_space/recording/instructions.h"

namespace ode_predictive_space::recording
{
namespace
{
std::vector<double> about(double microseconds)
{
    return {microseconds, 1.01 * microseconds, microseconds, 1.005 * microseconds, microseconds};
}

// A program with hash spaces that was recorded with predictive spaces in their place; its tick then takes 1000 us.
Findings found(double own, double box, double shape, double spared = 0)
{
    Findings findings;
    findings.events = 1000;
    findings.spaces = {
        {SpaceKind::hash, about(own)}, {SpaceKind::box, about(box)}, {SpaceKind::shape, about(shape), spared}};
    RecordedTick tick;
    tick.whole = 1000;
    tick.collide = box;
    tick.callbacks = 200;
    findings.tick = tick;
    return findings;
}

testing::AssertionResult says(const Findings &findings, const std::string &text)
{
    const std::string sentence = sentence_for(findings);
    return testing::AssertionResult(sentence.find(text) != std::string::npos) << sentence;
}

TEST(Advice, IsAboutTheTick)
{
    EXPECT_EQ(advice_for(found(400, 40, 45)), Advice::use);
    EXPECT_NEAR(gain_of(found(400, 40, 45), SpaceKind::box)->share, 360. / 1360, 0.001);
    EXPECT_EQ(advice_for(found(40, 60, 70)), Advice::leave);
    Findings slow = found(400, 40, 45);
    slow.tick->whole = 100000;
    EXPECT_EQ(advice_for(slow), Advice::leave) << "a tenth of the time in the spaces is nothing in this tick";
}

TEST(Advice, CountsWhatDCollideTakesForSparedCallbacks)
{
    EXPECT_EQ(advice_for(found(400, 40, 45, 100)), Advice::use_by_shape);
    EXPECT_EQ(advice_for(found(40, 60, 70, 100)), Advice::use_by_shape) << "by shape alone it pays";
    EXPECT_EQ(advice_for(found(400, 40, 45, 10)), Advice::use) << "not enough to be noticed";
}

TEST(Advice, IsNotGivenWhereReplaysDifferTooMuch)
{
    Findings findings = found(400, 40, 45);
    findings.spaces[0].costs = {400, 200, 400, 600, 400};
    EXPECT_EQ(advice_for(findings), Advice::unknown);
    EXPECT_TRUE(says(findings, "Measure again on an idle machine"));
}

TEST(Advice, IsNotGivenFromAFewCollides)
{
    Findings findings = found(400, 40, 45);
    findings.events = 7;
    EXPECT_EQ(advice_for(findings), Advice::unknown);
    EXPECT_TRUE(says(findings, "only 7 collides"));
}

TEST(Advice, IsNotGivenWithoutTheTimesOfTheProgram)
{
    Findings findings = found(400, 40, 45);
    findings.tick.reset();
    EXPECT_EQ(advice_for(findings), Advice::unknown);
    EXPECT_TRUE(says(findings, "What a tick would gain is not known"));
    EXPECT_TRUE(says(findings, "400 \xc2\xb5s in hash, 40 \xc2\xb5s in box, 45 \xc2\xb5s in shape."));
}

TEST(Advice, SaysWhatToDoAndWhatItRestsOn)
{
    Findings findings = found(400, 40, 45);
    EXPECT_TRUE(says(findings, "Use predictive spaces: a tick would be 26 % shorter (five replays differ by 0."));
    EXPECT_TRUE(says(findings,
                     "Write dPredictiveSpaceCreate(parent) for dHashSpaceCreate(parent), or start the program by "
                     "ode-predictive run. For the recording"));
    EXPECT_TRUE(says(findings,
                     "in predictive spaces: a tick took 1000 \xc2\xb5s, 4.0 % of it in collides, 20 % in callbacks."));
    EXPECT_TRUE(says(found(400, 40, 45, 100), "Use predictive spaces by shape: "));
    EXPECT_TRUE(
        says(found(400, 40, 45, 100), "and call dPredictiveSpaceSetProximity(space, dPredictiveProximityShape)"));
    EXPECT_TRUE(says(found(400, 40, 45, 100), "ode-predictive run --proximity shape."));
    EXPECT_TRUE(says(found(10, 40, 50), "Keep the program's spaces: in predictive ones a tick would be 3.1 % longer"));
}

TEST(Advice, SimpleSpacesAreReplacedOnlyOnRequest)
{
    Findings findings = found(400, 40, 45);
    findings.own = findings.spaces[0].kind = SpaceKind::simple;
    EXPECT_TRUE(
        says(findings, "for dSimpleSpaceCreate(parent), or start the program by ode-predictive run --space all."));
}

TEST(Advice, NamesTheBestOfOdesOwnSpaces)
{
    Findings findings = found(400, 40, 45);
    EXPECT_FALSE(says(findings, "With the best of ODE's"));
    findings.spaces.push_back({SpaceKind::sap, about(136)});
    findings.spaces.push_back({SpaceKind::quadtree, about(200)});
    findings.spaces.push_back({SpaceKind::simple, {}}); // this space ends the program
    EXPECT_TRUE(
        says(findings, "With the best of ODE's other spaces, sap, a tick would be 19 % shorter than with its own."));
}

TEST(Advice, KnowsThatTheProgramHasItAlready)
{
    Findings findings = found(400, 40, 45);
    findings.own = SpaceKind::box;
    EXPECT_EQ(advice_for(findings), Advice::leave);
    EXPECT_TRUE(says(findings, "Keep the program's spaces: they are predictive, by box. "));
    EXPECT_TRUE(says(findings, "With the best of ODE's spaces, hash, a tick would be 36 % longer than with its own."));
    findings.spaces[2].spared = 100;
    EXPECT_EQ(advice_for(findings), Advice::use_by_shape);
    EXPECT_TRUE(
        says(findings, ". Call dPredictiveSpaceSetProximity(space, dPredictiveProximityShape). For the recording"));
}

TEST(Instructions, AreReadFromWhatCallgrindWrites)
{
    EXPECT_EQ(collected("==7== Events    : Ir\n==7== Collected : 1234567\n==7== \n"), 1234567u);
    EXPECT_EQ(collected("==7== Collected : \n"), std::nullopt);
    EXPECT_EQ(collected("valgrind: no such program\n"), std::nullopt);
}
} // namespace
} // namespace ode_predictive_space::recording
