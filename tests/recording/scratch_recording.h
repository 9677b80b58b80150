#ifndef ODE_PREDICTIVE_SPACE_TESTS_RECORDING_SCRATCH_RECORDING_H
#define ODE_PREDICTIVE_SPACE_TESTS_RECORDING_SCRATCH_RECORDING_H

#include <cstdlib>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace ode_predictive_space::recording
{
class ScratchRecording
{
public:
    ScratchRecording() : path_(testing::TempDir() + "history_test.XXXXXX")
    {
        const int file = mkstemp(path_.data());
        if (file >= 0)
            close(file);
    }
    ~ScratchRecording() { unlink(path_.c_str()); }
    ScratchRecording(const ScratchRecording &) = delete;
    ScratchRecording &operator=(const ScratchRecording &) = delete;

    const std::string &path() const { return path_; }

private:
    std::string path_;
};
} // namespace ode_predictive_space::recording

#endif
