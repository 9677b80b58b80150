#ifndef ODE_PREDICTIVE_SPACE_RECORDING_COMMANDS_H
#define ODE_PREDICTIVE_SPACE_RECORDING_COMMANDS_H

#include <string>
#include <vector>

#include "ode_predictive_space/recording/replay.h"

namespace ode_predictive_space::recording
{
struct ReplayOptions
{
    std::vector<std::string> spaces;  ///< names of kinds; empty: all
    bool pairs_alone = false;         ///< count no instructions
    std::string reference = "simple"; ///< the kind of spaces with whose pairs all are compared
    CountedEvents events;             ///< whose instructions count
    std::string json_file;            ///< empty: none
    std::string counted;              ///< not empty: this process is under callgrind and replays in spaces of this kind
    std::string file;
};

/// @return 0 when all pairs agree, else 1. @throws std::runtime_error for a file that cannot be replayed.
int replay(const ReplayOptions &options);

/// Writes the page into an existing folder, also without a recording. @return the path of the page.
/// @throws std::runtime_error when the page cannot be written, or the file is no recording.
std::string write_report(const std::string &folder, const std::string &file, const std::string &title);
} // namespace ode_predictive_space::recording

#endif
