#include "ode_predictive_space/preload/program_file.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/scratch.h"

namespace ode_predictive_space::preload
{
namespace
{
TEST(ProgramFile, OtherFilesHaveNoOde)
{
    EXPECT_FALSE(has_ode_built_in("/nonexistent"));
    EXPECT_FALSE(has_ode_built_in("/"));
    EXPECT_FALSE(has_ode_built_in("/dev/null"));
    EXPECT_FALSE(has_ode_built_in("/etc/passwd"));
}

// The tables of a broken file must not cause reads outside it.
TEST(ProgramFile, BrokenFilesDoNoHarm)
{
    std::ifstream self("/proc/self/exe", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(self), {}};
    const ScratchFile file;
    const std::string &path = file.path();
    for (std::size_t size : {std::size_t(10), std::size_t(64), bytes.size() / 2, bytes.size() - 100})
    {
        std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(size));
        EXPECT_FALSE(has_ode_built_in(path.c_str())) << size;
    }
    for (std::size_t at = 40; at < 64; ++at)
    {
        std::string changed = bytes;
        changed[at] = '\xff';
        std::ofstream(path, std::ios::binary).write(changed.data(), static_cast<std::streamsize>(changed.size()));
        EXPECT_FALSE(has_ode_built_in(path.c_str())) << at;
    }
}
} // namespace
} // namespace ode_predictive_space::preload
