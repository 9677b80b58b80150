// The memory in which the programs under ode-predictive-run count, so that a program's end cannot take the counts along.
//
// The launcher creates it, a file without a name, and keeps it open; a program opens it through the launcher's entry in /proc and
// inherits nothing but an environment variable. That is input like any other: whatever it leads to is looked at before it is
// used. Size and pages of the file are fixed from the beginning, so that no access can fail later.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_COUNTS_FILE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_COUNTS_FILE_H

#include <memory>
#include <string>
#include <vector>

#include "ode_predictive_space/preload/counts.h"

namespace ode_predictive_space::preload
{
/// The environment variable by which programs find the file.
constexpr const char *counts_variable = "ODE_PREDICTIVE_COUNTS";

class CountsFile
{
public:
    /// A new one, empty; 0 with errno when the system does not give it.
    static std::unique_ptr<CountsFile> create();

    /// The one that name() of another process stands for; 0 when it leads to none.
    static std::unique_ptr<CountsFile> open(const char *name);

    ~CountsFile();
    CountsFile(const CountsFile &) = delete;
    CountsFile &operator=(const CountsFile &) = delete;

    /// For the environment variable, as long as this process lives and has the file open.
    std::string name() const;

    /// The open file; -1 for one that was opened by name.
    int file() const { return file_; }

    /// A number that no other process gets, except when 2^32 are exceeded.
    std::uint32_t new_process();

    /// A page of zeros that nobody else has; 0 when all are in use. Valid as long as this object.
    SpaceCounts *take_page();

    /// Some output of a process could not be written.
    void note_lost_output();
    bool has_lost_output() const;

    /// All that were taken, in this order.
    std::vector<SpaceCounts *> pages();

private:
    struct Layout;
    CountsFile(int file, Layout *layout) : file_(file), layout_(layout) {}

    int file_;
    Layout *layout_;
};
} // namespace ode_predictive_space::preload

#endif
