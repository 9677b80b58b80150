// Files and folders with unique names in the folder for temporary files. They go with their objects.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_SCRATCH_H
#define ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_SCRATCH_H

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace ode_predictive_space
{
class ScratchFile
{
public:
    explicit ScratchFile(const std::string &content = {}) : path_(testing::TempDir() + "scratch.XXXXXX")
    {
        const int file = mkstemp(path_.data());
        if (file >= 0)
            close(file);
        std::ofstream(path_) << content;
    }
    ~ScratchFile() { unlink(path_.c_str()); }
    ScratchFile(const ScratchFile &) = delete;
    ScratchFile &operator=(const ScratchFile &) = delete;

    const std::string &path() const { return path_; }

    std::string text() const
    {
        std::ifstream file(path_);
        return {std::istreambuf_iterator<char>(file), {}};
    }

private:
    std::string path_;
};

class ScratchFolder
{
public:
    ScratchFolder() : path_(testing::TempDir() + "scratch.XXXXXX")
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
} // namespace ode_predictive_space

#endif
