#include "ode_predictive_space/preload/settings.h"

#include <map>

#include <ode/collision.h>

#include <gtest/gtest.h>

#include "ode_predictive_space/predictive_space.h"

namespace ode_predictive_space::preload
{
namespace
{
using Environment = std::map<std::string, std::string>;

Settings read(const Environment &environment, std::size_t expected_complaints = 0)
{
    std::vector<std::string> complaints;
    const Settings settings = read_settings(
        [&](const char *name) {
            const auto found = environment.find(name);
            return found == environment.end() ? nullptr : found->second.c_str();
        },
        complaints);
    EXPECT_EQ(complaints.size(), expected_complaints);
    return settings;
}

const std::set<int> by_default = {dHashSpaceClass, dQuadTreeSpaceClass, dSweepAndPruneSpaceClass};

TEST(Settings, DefaultsAreTakenForWhatIsUnsetOrEmpty)
{
    for (const Environment &environment : {Environment{}, Environment{{"ODE_PREDICTIVE_SPACE", ""},
                                                                      {"ODE_PREDICTIVE_PROXIMITY", ""},
                                                                      {"ODE_PREDICTIVE_STATS", ""},
                                                                      {"ODE_PREDICTIVE_TRACE", ""}}})
    {
        const Settings settings = read(environment);
        EXPECT_EQ(settings.replaced, by_default);
        EXPECT_EQ(settings.proximity, dPredictiveProximityBox);
        EXPECT_FALSE(settings.monitors());
    }
}

TEST(Settings, TheOthers)
{
    EXPECT_EQ(read({{"ODE_PREDICTIVE_PROXIMITY", "sphere"}}).proximity, dPredictiveProximitySphere);
    EXPECT_EQ(read({{"ODE_PREDICTIVE_PROXIMITY", "shape"}}).proximity, dPredictiveProximityShape);
    EXPECT_EQ(read({{"ODE_PREDICTIVE_PROXIMITY", "ball"}}, 1).proximity, dPredictiveProximityBox);
    EXPECT_TRUE(read({{"ODE_PREDICTIVE_TRACE", "file"}}).monitors());
    EXPECT_TRUE(read({{"ODE_PREDICTIVE_RECORD", "file"}}).monitors());
    EXPECT_EQ(read({{"ODE_PREDICTIVE_RECORD", "file"}}).record_limit, default_record_limit);
    EXPECT_EQ(read({{"ODE_PREDICTIVE_RECORD_LIMIT", "3M"}}).record_limit, 3u << 20);
    EXPECT_EQ(read({{"ODE_PREDICTIVE_RECORD_LIMIT", "3T"}}, 1).record_limit, default_record_limit);
}

TEST(Settings, BytesAreNumbersWithOrWithoutAUnit)
{
    EXPECT_EQ(bytes_named("1000"), 1000u);
    EXPECT_EQ(bytes_named("2K"), 2048u);
    EXPECT_EQ(bytes_named("1G"), 1u << 30);
    for (const char *wrong : {"", "0", "K", "-1", "1.5M", "1 M", "1MB", "99999999999999999999", "2000000000G"})
        EXPECT_EQ(bytes_named(wrong), 0u) << wrong;
}
} // namespace
} // namespace ode_predictive_space::preload
