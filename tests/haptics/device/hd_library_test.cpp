#include "ode_predictive_space/haptics/device/hd_library.h"

#include "tests/support/error_of.h"

#include <gtest/gtest.h>
#include <set>

using namespace ode_predictive_space::haptics;
using ode_predictive_space::error_of;
using testing::IsSubstring;

namespace
{
DeviceError error_of_loading(const std::vector<std::string> &files)
{
    return error_of<DeviceError>([&] { const HdLibrary library(files); });
}

const std::vector<std::uint32_t> all_codes{0,     0x100, 0x101, 0x102, 0x103, 0x104, 0x200, 0x201, 0x202, 0x203,
                                           0x204, 0x300, 0x301, 0x302, 0x303, 0x304, 0x402, 0x501, 0x600};
} // namespace

TEST(HdLibrary, NamesEachFileThatIsNotThere)
{
    const DeviceError error = error_of_loading({"libabsent_hd.so", "libabsent_hd.so.3.0"});
    EXPECT_EQ(error.fault(), DeviceFault::missing_library);
    EXPECT_PRED_FORMAT2(IsSubstring, "libabsent_hd.so: cannot open shared object file", error.what());
    EXPECT_PRED_FORMAT2(IsSubstring, "libabsent_hd.so.3.0: cannot open shared object file", error.what());
}

TEST(HdLibrary, NamesTheFunctionThatAnotherVersionLacksAndItsFile)
{
    const DeviceError error = error_of_loading({FAKE_HD_OF_ANOTHER_VERSION});
    EXPECT_EQ(error.fault(), DeviceFault::missing_symbol);
    EXPECT_PRED_FORMAT2(IsSubstring, "hdUnschedule", error.what());
    EXPECT_PRED_FORMAT2(IsSubstring, FAKE_HD_OF_ANOTHER_VERSION, error.what());
}

TEST(HdLibrary, OfTheFirstFileThatIsThereDescribesErrorsByNameNumberAndItsWords)
{
    const HdLibrary library({"libabsent_hd.so", FAKE_HD});
    EXPECT_EQ(library.describe({0x200, 5}), "HD_WARM_MOTORS (0x200, internal code 5): The motors are warm.");
    EXPECT_EQ(library.describe({0x999, -1}), "unknown error (0x999, internal code -1): The stand-in's words.");
}

TEST(HdLibrary, KnowsANameForEveryError)
{
    std::set<std::string> names;
    for (const std::uint32_t code : all_codes)
        names.insert(name_of_hd_error(code));
    EXPECT_EQ(names.size(), all_codes.size());
    EXPECT_EQ(names.count("unknown error"), 0u);
}
