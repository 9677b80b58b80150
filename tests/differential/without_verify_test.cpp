// Linked with a predictive space that trusts its predictions blindly: the differential test must notice.

#include "tests/contract/support/ode_test.h"
#include "tests/differential/comparison.h"

namespace ode_predictive_space
{
namespace
{
class DifferentialWithoutVerify : public ::testing::TestWithParam<Flavour>
{};

TEST_P(DifferentialWithoutVerify, NoticesAndShrinks)
{
    const Profile profile{GetParam(), 20, 1000, true};
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
    {
        const History history = make_history(profile, seed);
        if (!compare(history))
            continue;
        const History shrunk = shrink(history, Measure::boxes, 300);
        EXPECT_TRUE(compare(shrunk).has_value());
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
