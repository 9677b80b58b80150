#include "ode_predictive_space/preload/gain.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include <fcntl.h>
#include <unistd.h>

#include "ode_predictive_space/process/child_output.h"

namespace ode_predictive_space::preload
{
namespace
{
// Beside the launcher; in a build, in the folder of its own sources.
std::string path_of_replayer()
{
    std::error_code none;
    const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    for (const char *folder : {".", REPLAY_BUILD_DIR})
        if (const std::filesystem::path path = here / folder / REPLAY_FILE; exists(path, none))
            return path;
    return "";
}

void become_replayer(const std::string &program, const std::string &recording, int output)
{
    // The launcher has closed its standard output, for the sake of the program's pipes: the pipe may be in its place.
    if (output == STDOUT_FILENO)
        fcntl(output, F_SETFD, 0);
    else
        dup2(output, STDOUT_FILENO);
    // It has blocked all signals, too.
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    unsetenv("LD_PRELOAD");
    execl(program.c_str(), program.c_str(), "--answer", recording.c_str(), nullptr);
}

std::optional<report::Answer> asked_of(const std::string &program, const std::string &recording)
{
    const auto lines = process::child_output([&](int pipe) { become_replayer(program, recording, pipe); });
    return lines ? report::answer_of(*lines) : std::nullopt;
}

report::Answer not_known(const std::string &why)
{
    report::Answer answer;
    answer.sentence = "What the program would gain is not known: " + why;
    return answer;
}
} // namespace

report::Answer gain_of(const std::string &recording)
{
    std::error_code none;
    if (!std::filesystem::exists(recording, none))
        return not_known("it collided no space that could be recorded.");
    const std::string program = path_of_replayer();
    if (program.empty())
        return not_known("ode-predictive-replay is missing.");
    std::optional<report::Answer> answer = asked_of(program, recording);
    if (!answer)
        return not_known("ode-predictive-replay could not replay " + recording + ".");
    answer->notes.push_back("Measured from the recording " + recording +
                            "; ode-predictive-replay, given this file, checks and counts more.");
    return *answer;
}
} // namespace ode_predictive_space::preload
