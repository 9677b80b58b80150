// Suppression of ODE's messages about trial steps, which the program has not made.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TRIAL_MESSAGES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TRIAL_MESSAGES_H

#include <cstdint>

namespace ode_predictive_space::haptics
{
/// Counts messages of ODE in its thread during its lifetime. Messages of other threads reach the program's handler.
class TrialMessages
{
public:
    TrialMessages();
    ~TrialMessages();
    TrialMessages(const TrialMessages &) = delete;
    TrialMessages &operator=(const TrialMessages &) = delete;

    std::uint64_t count() const;
};
} // namespace ode_predictive_space::haptics

#endif
