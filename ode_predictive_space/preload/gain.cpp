#include "ode_predictive_space/preload/gain.h"

#include <csignal>
#include <exception>
#include <filesystem>

#include <ode/ode.h>

#include "ode_predictive_space/history/recording.h"
#include "ode_predictive_space/replay/answer.h"

namespace ode_predictive_space::preload
{
namespace
{
report::Answer not_known(const std::string &why)
{
    report::Answer answer;
    answer.sentence = "What the program would gain is not known: " + why;
    return answer;
}

// The launcher has blocked all signals while the program ran; a user may interrupt replays.
void take_signals_again()
{
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
}
} // namespace

report::Answer gain_of(const std::string &recording)
try
{
    std::error_code none;
    if (!std::filesystem::exists(recording, none))
        return not_known("it collided no space that could be recorded.");
    take_signals_again();
    dInitODE2(0);
    report::Answer answer = replay::answer_for(history::Recording::read(recording));
    dCloseODE();
    answer.notes.push_back("Measured from the recording " + recording +
                           "; ode-predictive-replay, given this file, checks and counts more.");
    return answer;
}
catch (const std::exception &failure)
{
    return not_known(recording + ": " + failure.what());
}
} // namespace ode_predictive_space::preload
