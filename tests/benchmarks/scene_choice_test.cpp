#include "tests/benchmarks/scene_choice.h"

#include <gtest/gtest.h>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
struct Case
{
    std::string scene;
    int objects;
    int ticks;
};

const std::vector<Case> cases = {{"gas", 100, 1}, {"gas", 1000, 2}, {"pile", 500, 3}};

std::vector<int> ticks_of(const std::vector<std::string> &choices)
{
    std::vector<int> ticks;
    for (const Case &one : chosen(cases, choices))
    {
        ticks.push_back(one.ticks);
    }
    return ticks;
}

TEST(SceneChoice, IsANameOrANameAndASize)
{
    EXPECT_EQ(parse_scene_choice("gas").scene, "gas");
    EXPECT_FALSE(parse_scene_choice("gas").objects);
    EXPECT_EQ(parse_scene_choice("gas:1000").scene, "gas");
    EXPECT_EQ(parse_scene_choice("gas:1000").objects, 1000);
    for (const char *text : {"", ":", ":5", "gas:", "gas:0", "gas:-1", "gas:1000001", "gas:1e3", "gas:10 "})
    {
        EXPECT_THROW(parse_scene_choice(text), std::invalid_argument) << text;
    }
}

TEST(SceneChoice, WithoutChoicesAllCasesAreMeasured)
{
    EXPECT_EQ(ticks_of({}), (std::vector<int>{1, 2, 3}));
}

TEST(SceneChoice, AreMeasuredInTheirOrder)
{
    EXPECT_EQ(ticks_of({"pile", "gas"}), (std::vector<int>{3, 1, 2}));
    EXPECT_EQ(ticks_of({"gas:1000"}), (std::vector<int>{2}));
    EXPECT_THROW(chosen(cases, {"soup"}), std::invalid_argument);
}

TEST(SceneChoice, AnotherSizeIsMeasuredAsTheFirstOne)
{
    const std::vector<Case> result = chosen(cases, {"gas:7"});
    ASSERT_EQ(result.size(), 1u);
    EXPECT_EQ(result[0].objects, 7);
    EXPECT_EQ(result[0].ticks, 1);
}
} // namespace
} // namespace ode_predictive_space::benchmarks
