// The line that says which ODE was measured.

#include "tests/benchmarks/which_ode.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
TEST(WhichOde, NamesTheLibraryAndItsAssertions)
{
    const std::string text = which_ode();
    EXPECT_NE(text.find("libode"), std::string::npos) << text;
    EXPECT_NE(text.find("ODE_double_precision"), std::string::npos) << text;
    EXPECT_NE(text.find("assertions o"), std::string::npos) << text;
}
} // namespace
} // namespace ode_predictive_space::benchmarks
