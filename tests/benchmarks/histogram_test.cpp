#include "tests/benchmarks/histogram.h"

#include <gtest/gtest.h>
#include <numeric>
#include <sstream>

namespace ode_predictive_space::benchmarks
{
namespace
{
TEST(Histogram, EveryValueIsInItsBin)
{
    const std::vector<double> values = {1, 1.1, 3, 10, 10, 99, 1000, 0};
    const Histogram histogram = histogram_of(values);
    ASSERT_EQ(histogram.edges.size(), histogram.counts.size() + 1);
    EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0}), values.size());
    EXPECT_DOUBLE_EQ(histogram.edges.front(), 1);
    EXPECT_GE(histogram.edges.back(), 1000);
    EXPECT_EQ(histogram.counts.front(), 3u) << "1, 1.1, and 0, which is less than all bins";
    EXPECT_EQ(histogram.counts[10], 2u) << "ten bins per factor of ten";
    EXPECT_EQ(histogram.counts.back(), 1u);
}

TEST(Histogram, OfNothingIsEmpty)
{
    EXPECT_TRUE(histogram_of({}).counts.empty());
    EXPECT_TRUE(histogram_of({0, 0}).counts.empty());
}

TEST(Histogram, ASingleTickCanBeSeen)
{
    std::ostringstream text;
    print(text, histogram_of({1, 1, 1, 1, 50}));
    const std::string last = text.str().substr(text.str().rfind('\n', text.str().size() - 2) + 1);
    EXPECT_NE(last.find('#'), std::string::npos) << text.str();
}
} // namespace
} // namespace ode_predictive_space::benchmarks
