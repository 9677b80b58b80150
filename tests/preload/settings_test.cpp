#include "ode_predictive_space/preload/settings.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::preload
{
namespace
{
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
