#ifndef ODE_PREDICTIVE_SPACE_RECORDING_NO_SIGNAL_OF_WRITING_H
#define ODE_PREDICTIVE_SPACE_RECORDING_NO_SIGNAL_OF_WRITING_H

#include <cerrno>
#include <csignal>
#include <ctime>

namespace ode_predictive_space::recording
{
/// Holds back SIGXFSZ and SIGPIPE of this thread's failed writes, which would end a program that does not expect them.
class NoSignalOfWriting
{
public:
    NoSignalOfWriting()
    {
        sigset_t held;
        sigemptyset(&held);
        for (int signal : signals_of_writing)
            sigaddset(&held, signal);
        sigpending(&pending_);
        pthread_sigmask(SIG_BLOCK, &held, &mask_);
    }

    // A signal that was pending before is the program's.
    ~NoSignalOfWriting()
    {
        const int error = errno;
        for (int signal : signals_of_writing)
        {
            sigset_t one;
            sigemptyset(&one);
            sigaddset(&one, signal);
            const timespec at_once = {0, 0};
            if (!sigismember(&pending_, signal))
                sigtimedwait(&one, nullptr, &at_once);
        }
        pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
        errno = error;
    }

    NoSignalOfWriting(const NoSignalOfWriting &) = delete;
    NoSignalOfWriting &operator=(const NoSignalOfWriting &) = delete;

private:
    static constexpr int signals_of_writing[] = {SIGPIPE, SIGXFSZ};
    sigset_t mask_, pending_; // before
};
} // namespace ode_predictive_space::recording

#endif
