// A device that is read and written in each tick, with its failures.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_LINK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_LINK_H

#include "ode_predictive_space/haptics/device/at_end.h"
#include "ode_predictive_space/haptics/device/device_motion.h"
#include "ode_predictive_space/haptics/safety/device_gate.h"
#include "ode_predictive_space/haptics/safety/notice_desk.h"

#include <limits>

namespace ode_predictive_space::haptics
{
/// Opens a device unless it is open, and registers it for zero force at the end of the program. A device that throws,
/// reports nonsense or nothing new has failed: it gets zero force, and is tried again ten times a second. A device that
/// refuses zero is closed. Neither allocates nor locks while the device answers.
class DeviceLink
{
public:
    struct News
    {
        bool came_back = false;    ///< it answers, but not in the tick before
        bool only_doubted = false; ///< it reported nonsense so briefly that the hand may still be in contact
        bool had_failed = false;   ///< it answers after a reported failure
        bool was_away = false;     ///< it answers after so long that it can be anywhere
        bool has_jumped = false;   ///< it moved farther than a hand in a tick
    };

    /// @param device not owned; must outlive the link. @throws DeviceError; std::logic_error when another link has it.
    DeviceLink(Device &device, const NoticeDesk &notices);

    /// Closes the device if it was opened here.
    ~DeviceLink();
    DeviceLink(const DeviceLink &) = delete;
    DeviceLink &operator=(const DeviceLink &) = delete;

    /// Begins a tick. @return whether a guard took the force away since the last one.
    bool notice_guard();

    /// @param time s, simulated. @param rate Hz; of reads. @param top_speed m/s; a higher speed counts as a jump.
    News read(double time, double rate, double top_speed);

    Wrench write(const Wrench &wrench);

    bool answers() const { return answers_; }

    bool guard_acted() const { return guard_acted_; }

    /// The last valid state with a velocity, in the device's frame.
    const DeviceState &state() const { return state_; }

    /// m/s; measured from positions.
    double speed() const { return motion_.speed(); }
    void forget_motion() { motion_.forget(); }

    const Capabilities &capabilities() const { return gate_.device().capabilities(); }
    DeviceGate &gate() { return gate_; }

private:
    template <typename Call> bool attempt(const Call &call);
    bool follow(const DeviceState &state, double rate);
    bool is_silent(const DeviceState &state, double rate);
    void fail(std::string_view why);
    void doubt(std::string_view why);

    static constexpr double never = -std::numeric_limits<double>::infinity(); ///< s

    DeviceGate gate_;
    AtEnd opening_; ///< closes the device if it was opened here
    const NoticeDesk &notices_;
    DeviceMotion motion_;
    DeviceState state_;
    double time_ = 0; ///< s, simulated; of the last read()
    bool answers_ = false;
    bool failed_ = false;                                               ///< without an answer since
    bool guard_acted_ = false;                                          ///< since the last tick
    double doubted_since_ = never;                                      ///< s, simulated; beginning of nonsense
    double next_try_ = never;                                           ///< s, simulated; next try of a failed device
    double last_news_ = 0;                                              ///< s, simulated; of the last new state
    double last_state_time_ = std::numeric_limits<double>::quiet_NaN(); ///< s; the device's time of the last state
    double last_answer_ = never;                                        ///< s, simulated
};
} // namespace ode_predictive_space::haptics

#endif
