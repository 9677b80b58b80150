#ifndef ODE_PREDICTIVE_SPACE_TESTS_PRELOAD_PRELOAD_PROGRAMS_H
#define ODE_PREDICTIVE_SPACE_TESTS_PRELOAD_PRELOAD_PROGRAMS_H

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/program.h"

namespace ode_predictive_space::preload
{
/// AddressSanitizer requires its library to be the first in a process; ours comes before it and does no harm.
inline void allow_preload()
{
    setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1);
}

inline Outcome launch(const std::string &arguments)
{
    allow_preload();
    return run(LAUNCHER, arguments);
}

class ScratchFile
{
public:
    ScratchFile() : path_(testing::TempDir() + "preload_test.XXXXXX")
    {
        const int file = mkstemp(path_.data());
        if (file >= 0)
            close(file);
    }
    ~ScratchFile() { unlink(path_.c_str()); }
    ScratchFile(const ScratchFile &) = delete;
    ScratchFile &operator=(const ScratchFile &) = delete;

    const std::string &path() const { return path_; }

    std::string text() const
    {
        std::ostringstream text;
        text << std::ifstream(path_).rdbuf();
        return text.str();
    }

private:
    std::string path_;
};

class ScratchFolder
{
public:
    ScratchFolder() : path_(testing::TempDir() + "preload_test.XXXXXX")
    {
        if (!mkdtemp(path_.data()))
            path_.clear();
    }
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    ScratchFolder(const ScratchFolder &) = delete;
    ScratchFolder &operator=(const ScratchFolder &) = delete;

    const std::string &path() const { return path_; }

private:
    std::string path_;
};

inline int count_of(const std::string &part, const std::string &text)
{
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}
} // namespace ode_predictive_space::preload

#endif
