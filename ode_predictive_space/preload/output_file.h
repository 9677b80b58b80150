// Files that the programs and the launcher append to. Nothing that cannot be written is lost without a message.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_OUTPUT_FILE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_OUTPUT_FILE_H

#include <atomic>
#include <string>

#include "ode_predictive_space/recording/no_signal_of_writing.h"

namespace ode_predictive_space::preload
{
using recording::NoSignalOfWriting;

/// A file to append to. Without a buffer: a text is written at once and in one piece, also when other processes write to the same
/// file, and when this one forks there is nothing left that its child would write again. Any number of threads may write.
class OutputFile
{
public:
    explicit OutputFile(const std::string &path);
    ~OutputFile();
    OutputFile(const OutputFile &) = delete;
    OutputFile &operator=(const OutputFile &) = delete;

    /// @return whether all of it is written. After the first failure, of opening also, there is one line on standard error, and
    /// nothing more is written.
    bool write(const std::string &text);

    /// @return whether all that was written is in the file; a line on standard error otherwise.
    bool close();

private:
    void fail();

    std::string path_;
    int file_;
    std::atomic<bool> failed_{false};
};
} // namespace ode_predictive_space::preload

#endif
