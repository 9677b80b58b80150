#include "tests/support/program.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::ode_demos
{
namespace
{
Outcome run_chain(const std::string &options)
{
    return run(ODE_DEMOS "/demo_chain1", "-headless 20 " + options);
}

TEST(OdeDemoOptions, EverySpaceHasItsName)
{
    for (const std::string name : {"simple", "hash", "quadtree", "sap", "predictive"})
    {
        const Outcome outcome = run_chain("-space " + name);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(contains(outcome.output, "predictive space: valid"), name == "predictive") << outcome.output;
    }
}

TEST(OdeDemoOptions, ADemoUsesItsOwnSpaceWithoutThem)
{
    const Outcome outcome = run_chain("");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(contains(outcome.output, "steps: 20\n")) << outcome.output;
    EXPECT_FALSE(contains(outcome.output, "predictive")) << outcome.output;
    EXPECT_FALSE(contains(outcome.output, "probe")) << outcome.output;
}

TEST(OdeDemoOptions, WhatMakesNoSenseIsSaid)
{
    const std::pair<const char *, const char *> mistakes[] = {
        {"-space octree", "no space is called \"octree\""},
        {"-space", "-space takes"},
        {"-probe spoon", "\"spoon\""},
        {"-probe replay:/there/is/none", "/there/is/none"},
        {"-probe", "-probe needs a value"},
        {"-headless 0", "-headless takes"},
        {"-objects none", "-objects takes"},
    };
    for (const auto &[options, words] : mistakes)
    {
        const Outcome outcome = run_chain(options);
        EXPECT_EQ(outcome.status, 1) << options;
        EXPECT_TRUE(contains(outcome.output, words)) << options << ": " << outcome.output;
    }
}

TEST(OdeDemoOptions, KeysArePressed)
{
    const Outcome outcome = run(ODE_DEMOS "/demo_boxstack", "-headless 100 -keys bsx");
    EXPECT_FALSE(contains(outcome.output, "pairs: 0\n")) << outcome.output << "it begins empty";
}

TEST(OdeDemoOptions, AProbeOutlivesTheSpaceOfADemoThatBeginsAnew)
{
    const Outcome outcome = run(ODE_DEMOS "/demo_crash", "-headless 25 -space predictive -probe virtual -keys rr");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "steps: 25\n")) << outcome.output;
}
} // namespace
} // namespace ode_predictive_space::ode_demos
