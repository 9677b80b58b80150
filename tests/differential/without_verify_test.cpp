// Linked with a predictive space that never verifies its predictions: the differential test must notice.

#include "tests/contract/support/ode_test.h"
#include "tests/differential/comparison.h"

namespace ode_predictive_space
{
namespace
{
class DifferentialWithoutVerify : public ::testing::TestWithParam<Flavour>
{};

// Only the pairs are compared: a program would not see that the invariant is broken.
TEST_P(DifferentialWithoutVerify, NoticesAndShrinks)
{
    const Terms terms{Measure::boxes, false};
    const Profile profile{GetParam(), 20, 1000, true};
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
    {
        const History history = make_history(profile, seed);
        const auto failure = compare(history, terms);
        if (!failure || failure->kind != FailureKind::pairs)
            continue;
        const History shrunk = shrink(history, terms, 300);
        const auto shrunk_failure = compare(shrunk, terms);
        ASSERT_TRUE(shrunk_failure.has_value());
        EXPECT_EQ(shrunk_failure->kind, FailureKind::pairs);
        EXPECT_LT(shrunk.operations.size(), history.operations.size());
        return;
    }
    FAIL() << "no difference was noticed";
}

INSTANTIATE_TEST_SUITE_P(Each, DifferentialWithoutVerify,
                         ::testing::Values(Flavour::calm, Flavour::mixed, Flavour::wild, Flavour::pile),
                         [](const ::testing::TestParamInfo<Flavour> &info) { return flavour_name(info.param); });
} // namespace
} // namespace ode_predictive_space
