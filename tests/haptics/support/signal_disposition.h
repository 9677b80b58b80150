// What a signal does to the test program: no test may depend on what the program was started with, by nohup, say.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_SIGNAL_DISPOSITION_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_SIGNAL_DISPOSITION_H

#include <csignal>

namespace ode_predictive_space::haptics
{
/// A handler of the program's own, which the test's end takes away again.
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
