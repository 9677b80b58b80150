#include "demos/runs/table.h"

#include <gtest/gtest.h>
#include <sstream>

namespace ode_predictive_space::worlds
{
namespace
{
TEST(Numbers, AreGroupedByThousands)
{
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(1234567), "1,234,567");
    EXPECT_EQ(fixed(1234567.25, 1), "1,234,567.2");
    EXPECT_EQ(fixed(999.96, 1), "1,000.0");
    EXPECT_EQ(fixed(-1234.5, 1), "-1,234.5");
    EXPECT_EQ(fixed(-0.01, 1), "0.0");
    EXPECT_EQ(fixed(12, 0), "12");
}

TEST(Numbers, HashesHaveSixteenDigits)
{
    EXPECT_EQ(hexadecimal(0xabc), "0000000000000abc");
}

TEST(Table, ColumnsAreAlignedAlsoWhereACharacterTakesTwoBytes)
{
    Table table({"space", "µs"});
    table.add({"a", "1.0"});
    table.add({"longer", "200.0"});
    std::ostringstream out;
    table.print(out);
    EXPECT_EQ(out.str(), "space      µs\n"
                         "-------------\n"
                         "a         1.0\n"
                         "longer  200.0\n");
}
} // namespace
} // namespace ode_predictive_space::worlds
