// Messages of ODE about steps that are only tried.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TRIAL_MESSAGES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TRIAL_MESSAGES_H

#include <cstdint>

namespace ode_predictive_space::haptics
{
/// As long as one of these lives, messages of ODE in its thread are counted, and do not reach the program, which has not made the
/// steps that they are about. Messages of other threads reach the program's handler as usual.
class TrialMessages
{
public:
    TrialMessages();
    ~TrialMessages();
    TrialMessages(const TrialMessages &) = delete;
    TrialMessages &operator=(const TrialMessages &) = delete;

    /// So far, in this thread.
    std::uint64_t count() const;
};
} // namespace ode_predictive_space::haptics

#endif
