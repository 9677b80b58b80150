// Everyday and long runs of the differential test. A failure names its seed and prints the shrunk history.

#include <tuple>

#include "tests/contract/support/ode_test.h"
#include "tests/differential/comparison.h"

namespace ode_predictive_space
{
namespace
{
struct Size
{
    const char *name;
    int geoms;
    int ticks;
    int histories;
};

void PrintTo(const Size &size, std::ostream *stream)
{
    *stream << size.name;
}

using Parameters = std::tuple<Flavour, Size>;

std::string name_of(const ::testing::TestParamInfo<Parameters> &info)
{
    return std::string(flavour_name(std::get<0>(info.param))) + "_" + std::get<1>(info.param).name;
}

class Differential : public ::testing::TestWithParam<Parameters>
{
protected:
    // Some scenes are smaller than requested, so that the tiny ones include scenes of 2 geoms.
    Tally run(Measure measure, std::uint64_t first_seed)
    {
        const auto [flavour, size] = GetParam();
        Tally tally;
        for (int i = 0; i < size.histories; ++i)
        {
            const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
            const int geoms = std::max(2, size.geoms * (10 - i % 10) / 10);
            const Profile profile{flavour, geoms, size.ticks, measure == Measure::boxes};
            const std::string report = report_of(profile, seed, {measure}, &tally);
            EXPECT_EQ(report, "") << "seed " << seed;
            if (!report.empty())
                break;
        }
        EXPECT_GT(tally.pairs, tally.ticks / 4) << "the histories are about nothing";
        return tally;
    }
};

class DifferentialBySpheres : public Differential
{};

TEST_P(Differential, SamePairs)
{
    run(Measure::boxes, 1);
}

TEST_P(DifferentialBySpheres, NoContactIsLeftOut)
{
    EXPECT_GT(run(Measure::spheres, 1001).left_out, 0u) << "the measure made no difference";
}

const auto every_flavour = ::testing::Values(Flavour::calm, Flavour::mixed, Flavour::wild, Flavour::teleport,
                                             Flavour::pile, Flavour::extreme, Flavour::far);

// With so many geoms, not all broken predictions are replaced in one tick.
const auto explosions = ::testing::Values(Flavour::explosion);

// The other tests of proximity would leave out pairs of spaces.
const auto nests = ::testing::Values(Flavour::nests);

#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
INSTANTIATE_TEST_SUITE_P(Long, Differential,
                         ::testing::Combine(every_flavour, ::testing::Values(Size{"tiny", 20, 4000, 400},
                                                                             Size{"medium", 300, 1500, 40},
                                                                             Size{"large", 1500, 100, 20})),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Long, DifferentialBySpheres,
                         ::testing::Combine(every_flavour, ::testing::Values(Size{"tiny", 20, 2000, 400},
                                                                             Size{"medium", 200, 500, 50})),
                         name_of);
INSTANTIATE_TEST_SUITE_P(LongExplosions, Differential,
                         ::testing::Combine(explosions, ::testing::Values(Size{"many", 1000, 300, 60})), name_of);
INSTANTIATE_TEST_SUITE_P(LongNests, Differential,
                         ::testing::Combine(nests, ::testing::Values(Size{"tiny", 20, 2000, 400},
                                                                     Size{"medium", 200, 500, 50})),
                         name_of);
INSTANTIATE_TEST_SUITE_P(LongExplosions, DifferentialBySpheres,
                         ::testing::Combine(explosions, ::testing::Values(Size{"many", 600, 300, 30})), name_of);
#else
INSTANTIATE_TEST_SUITE_P(Short, Differential,
                         ::testing::Combine(every_flavour,
                                            ::testing::Values(Size{"tiny", 20, 1500, 100}, Size{"medium", 200, 400, 10},
                                                              Size{"large", 1200, 20, 2})),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Short, DifferentialBySpheres,
                         ::testing::Combine(every_flavour,
                                            ::testing::Values(Size{"tiny", 20, 1000, 40}, Size{"medium", 150, 200, 8})),
                         name_of);
INSTANTIATE_TEST_SUITE_P(ShortExplosions, Differential,
                         ::testing::Combine(explosions, ::testing::Values(Size{"many", 500, 150, 6})), name_of);
INSTANTIATE_TEST_SUITE_P(ShortNests, Differential,
                         ::testing::Combine(nests, ::testing::Values(Size{"tiny", 20, 1000, 200},
                                                                     Size{"medium", 150, 200, 20})),
                         name_of);
INSTANTIATE_TEST_SUITE_P(ShortExplosions, DifferentialBySpheres,
                         ::testing::Combine(explosions, ::testing::Values(Size{"many", 400, 100, 4})), name_of);
#endif
} // namespace
} // namespace ode_predictive_space
