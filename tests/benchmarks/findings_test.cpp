#include "tests/benchmarks/findings.h"

#include <gtest/gtest.h>
#include <sstream>

namespace ode_predictive_space::benchmarks
{
namespace
{
TEST(Findings, ARequirementIsMetAtItsLimit)
{
    EXPECT_TRUE((Requirement{"P1", "", 2, Requirement::at_least, 2, "x"}.met()));
    EXPECT_FALSE((Requirement{"P1", "", 1.9, Requirement::at_least, 2, "x"}.met()));
    EXPECT_TRUE((Requirement{"P1", "", 2, Requirement::at_most, 2, "x"}.met()));
    EXPECT_FALSE((Requirement{"P1", "", 2.1, Requirement::at_most, 2, "x"}.met()));
}

TEST(Findings, AreListedInTheOrderOfTheirLines)
{
    Findings findings;
    findings.require({"P10", "ten", 1, Requirement::at_least, 2, "x"});
    findings.require({"P9", "nine", 3, Requirement::at_least, 2, "x"});
    findings.note("something was left out");
    findings.note("something was left out");
    std::ostringstream text;
    findings.print(text);
    EXPECT_LT(text.str().find("P9  nine"), text.str().find("P10  ten")) << text.str();
    EXPECT_NE(text.str().find("1 of 2 met"), std::string::npos) << text.str();
    EXPECT_EQ(text.str().find("something was"), text.str().rfind("something was")) << "a note is told once";
}

TEST(Findings, AreRecordsForOtherPrograms)
{
    Findings findings;
    findings.require({"P9", "nine", 3, Requirement::at_most, 2, "x"});
    findings.record({{"scene", "gas"}});
    const nlohmann::json records = findings.records();
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[0].at("scene"), "gas");
    EXPECT_EQ(records[1].at("line"), "P9");
    EXPECT_EQ(records[1].at("met"), false);
    EXPECT_EQ(records[1].at("value"), 3.0);
    EXPECT_EQ(records[1].at("bound"), "<=");
}

TEST(Findings, TheFirstFailureStays)
{
    Findings findings;
    EXPECT_EQ(findings.status(), exit_ok);
    findings.fail(exit_wrong_pairs);
    findings.fail(exit_failed);
    EXPECT_EQ(findings.status(), exit_wrong_pairs);
}
} // namespace
} // namespace ode_predictive_space::benchmarks
