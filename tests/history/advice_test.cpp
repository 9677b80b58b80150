#include "ode_predictive_space/replay/advice.h"

#include <gtest/gtest.h>

#include "ode_predictive_space/replay/instructions.h"

namespace ode_predictive_space::replay
{
namespace
{
Findings found(double own, double box, double shape, double spared_time = 0)
{
    Findings findings;
    findings.events = 1000;
    findings.own_name = "hash";
    findings.own = own;
    findings.box = box;
    findings.shape = shape;
    findings.callbacks = 100;
    findings.spared = 60;
    findings.spared_time = spared_time;
    return findings;
}

TEST(Advice, FollowsTheLeastTime)
{
    EXPECT_EQ(advice_for(found(400, 40, 45)), Advice::use);
    EXPECT_EQ(advice_for(found(400, 40, 45, 30)), Advice::use_by_shape) << "dCollide is spared";
    EXPECT_EQ(advice_for(found(40, 60, 70)), Advice::leave);
    EXPECT_EQ(advice_for(found(40, 60, 70, 50)), Advice::use_by_shape) << "by shape alone it pays";
}

TEST(Advice, IgnoresDifferencesWithinNoiseAndUnnoticeableGains)
{
    EXPECT_EQ(advice_for(found(40, 38, 38)), Advice::leave);
    EXPECT_EQ(advice_for(found(1.5, 0.7, 0.7)), Advice::leave);
    EXPECT_EQ(advice_for(found(400, 40, 39)), Advice::use);
}

TEST(Advice, IsNotGivenFromAFewCollides)
{
    Findings findings = found(400, 40, 45);
    findings.events = 7;
    EXPECT_EQ(advice_for(findings), Advice::unknown);
    EXPECT_NE(sentence_for(findings).find("only 7 collides"), std::string::npos);
}

TEST(Advice, SaysWhatToDoAndWhy)
{
    Findings findings = found(400, 40, 45);
    EXPECT_EQ(sentence_for(findings).find("Use it (ode-predictive-run): "), 0u) << sentence_for(findings);
    EXPECT_NE(sentence_for(findings).find("400 \xc2\xb5s in the program's own spaces (hash), 40 \xc2\xb5s in"),
              std::string::npos);
    findings.own_is_simple = true;
    EXPECT_EQ(sentence_for(findings).find("Use it (ode-predictive-run --space all): "), 0u)
        << "simple spaces are replaced only then";
    findings.spared_time = 30;
    EXPECT_EQ(sentence_for(findings).find("Use it by shape (ode-predictive-run --space all --proximity shape): "), 0u);
    EXPECT_EQ(sentence_for(found(10, 20, 30)).find("Leave it, as predictive spaces are not faster here: "), 0u);
    EXPECT_EQ(sentence_for(found(10, 9.5, 30)).find("Leave it, as the gain is too small to notice: "), 0u);
    EXPECT_EQ(sentence_for(found(0.9, 0.1, 0.2)).find("Leave it, as there is nothing to gain: "), 0u);
}

TEST(Advice, NamesSparedCallbacksWhereThereAreAny)
{
    Findings findings = found(400, 40, 45);
    EXPECT_NE(sentence_for(findings).find("which also spares 60 of 100 callbacks"), std::string::npos);
    findings.spared = 0;
    EXPECT_NE(sentence_for(findings).find("by shape, which spares less than 1 % of the callbacks."), std::string::npos)
        << sentence_for(findings);
}

TEST(Advice, HasNoExponents)
{
    Findings findings = found(4000, 1234, 5678.4);
    findings.callbacks = 2000;
    findings.spared = 1030.2;
    EXPECT_NE(
        sentence_for(findings).find("1234 \xc2\xb5s in predictive ones, 5678 \xc2\xb5s by shape, which also spares "
                                    "1030 of 2000 callbacks"),
        std::string::npos)
        << sentence_for(findings);
}

TEST(Instructions, AreReadFromWhatCallgrindWrites)
{
    EXPECT_EQ(collected("==7== Events    : Ir\n==7== Collected : 1234567\n==7== \n"), 1234567u);
    EXPECT_EQ(collected("==7== Collected : \n"), std::nullopt);
    EXPECT_EQ(collected("valgrind: no such program\n"), std::nullopt);
}
} // namespace
} // namespace ode_predictive_space::replay
