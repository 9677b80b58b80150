// Signals that end a program, as a flag that a servo loop can look at.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_STOP_REQUEST_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_STOP_REQUEST_H

namespace ode_predictive_space::haptics
{
/// As long as one of these lives, SIGINT, SIGTERM, SIGHUP and SIGQUIT do not end the program but set a flag: the loop then takes the force
/// away and ends in good order. The last one that goes puts back the handlers that the first one found.
///
/// A signal that was ignored before (nohup does that to SIGHUP) stays ignored. Signals that cannot be caught (SIGKILL) or after
/// which nothing can be trusted (SIGSEGV) are left alone: there the device's driver has to notice that the program is gone.
class StopRequest
{
public:
    /// The first one also forgets a request from before. @throws std::system_error when a handler cannot be installed.
    StopRequest();
    ~StopRequest();
    StopRequest(const StopRequest &) = delete;
    StopRequest &operator=(const StopRequest &) = delete;

    /// Whether the program is to end. Any thread; neither locks nor allocates.
    static bool requested() noexcept;

    /// The signal that asked for it; 0 when none did. For a message, or to raise it anew after the end of the loop.
    static int signal() noexcept;

    /// The same without a signal; for a window that is closed, say. Any thread, and signal handlers.
    static void request() noexcept;
};
} // namespace ode_predictive_space::haptics

#endif
