#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_OUTPUT_FILE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_OUTPUT_FILE_H

#include <atomic>
#include <string>

#include "ode_predictive_space/recording/no_signal_of_writing.h"

namespace ode_predictive_space::preload
{
using recording::NoSignalOfWriting;

/// A file to append to, without a buffer: a text is written at once and in one piece, also when other processes write to the
/// same file, and a forked child has nothing left to write again. Any number of threads may write.
class OutputFile
{
public:
    explicit OutputFile(const std::string &path);
    ~OutputFile();
    OutputFile(const OutputFile &) = delete;
    OutputFile &operator=(const OutputFile &) = delete;

    /// @return whether all is written. The first failure, also of opening, writes a line to standard error and ends writing.
    bool write(const std::string &text);

private:
    void fail();

    std::string path_;
    int file_;
    std::atomic<bool> failed_{false};
};
} // namespace ode_predictive_space::preload

#endif
