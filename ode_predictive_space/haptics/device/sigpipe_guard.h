// Keeps a server's hanging up from ending the program.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_SIGPIPE_GUARD_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_SIGPIPE_GUARD_H

#include <csignal>
#include <ctime>

namespace ode_predictive_space::haptics
{
/// While it lives, writing to a socket without a reader raises no signal in this thread. For libraries that write with
/// write().
class SigpipeGuard
{
public:
    SigpipeGuard()
    {
        sigset_t pending;
        sigpending(&pending);
        was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        sigemptyset(&sigpipe_);
        sigaddset(&sigpipe_, SIGPIPE);
        pthread_sigmask(SIG_BLOCK, &sigpipe_, &mask_before_);
    }

    ~SigpipeGuard()
    {
        const timespec at_once{0, 0};
        if (!was_pending_)
            sigtimedwait(&sigpipe_, nullptr, &at_once);
        pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
    }

    SigpipeGuard(const SigpipeGuard &) = delete;
    SigpipeGuard &operator=(const SigpipeGuard &) = delete;

private:
    sigset_t sigpipe_;
    sigset_t mask_before_;
    bool was_pending_;
};
} // namespace ode_predictive_space::haptics

#endif
