// Sets the disposition of a signal and restores it at the end, so that no test depends on an inherited one, as of nohup.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_SIGNAL_DISPOSITION_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_SIGNAL_DISPOSITION_H

#include <csignal>

namespace ode_predictive_space::haptics
{
class SignalDisposition
{
public:
    explicit SignalDisposition(int number, void (*handler)(int) = SIG_DFL)
        : number_(number), before_(std::signal(number, handler))
    {}
    ~SignalDisposition() { std::signal(number_, before_); }
    SignalDisposition(const SignalDisposition &) = delete;
    SignalDisposition &operator=(const SignalDisposition &) = delete;

private:
    int number_;
    void (*before_)(int);
};
} // namespace ode_predictive_space::haptics

#endif
