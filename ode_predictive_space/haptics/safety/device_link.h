// A device that is read and written in each tick, and may fail in any of them.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_LINK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_LINK_H

#include "ode_predictive_space/haptics/device/at_end.h"
#include "ode_predictive_space/haptics/device/device_motion.h"
#include "ode_predictive_space/haptics/safety/device_gate.h"
#include "ode_predictive_space/haptics/safety/notice_desk.h"

#include <limits>

namespace ode_predictive_space::haptics
{
/// Opens a device unless it is open, and makes it known to what takes the force away when the program ends. A device that throws, tells
/// nonsense, or tells nothing new has failed: it gets zero force, and is tried again ten times a second. One that does not even take
/// the zero is closed. Neither allocates nor locks as long as the device answers.
class DeviceLink
{
public:
    /// What a read() came to.
    struct News
    {
        bool came_back = false; ///< it answers, and did not in the tick before
        bool only_doubted =
            false; ///< it had told nonsense, and only for so long that the hand may still lean on something
        bool had_failed = false; ///< it answers, and a notice told that it does not
        bool was_away = false;   ///< it answers, and did not for so long that it can be anywhere
        bool has_jumped = false; ///< no hand moves as far in a tick
    };

    /// @param device is not owned, and must outlive the link. @throws DeviceError; std::logic_error when another link has it.
    DeviceLink(Device &device, const NoticeDesk &notices);

    /// Closes the device if it was opened here.
    ~DeviceLink();
    DeviceLink(const DeviceLink &) = delete;
    DeviceLink &operator=(const DeviceLink &) = delete;

    /// A tick begins. @return whether a guard took the force away since the last one.
    bool notice_guard();

    /// @param time s, simulated. @param rate Hz; how often it is read. @param top_speed m/s; beyond it, the position has jumped.
    News read(double time, double rate, double top_speed);

    /// @return what was written: zero when it could not be.
    Wrench write(const Wrench &wrench);

    bool answers() const { return answers_; }

    /// What notice_guard() returned.
    bool guard_acted() const { return guard_acted_; }

    /// The device's frame; as read last, and with a velocity.
    const DeviceState &state() const { return state_; }

    /// m/s; by the positions, whatever the device tells.
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
    bool failed_ = false;          ///< and has not answered since
    bool guard_acted_ = false;     ///< since the last tick
    double doubted_since_ = never; ///< s, simulated; since when the device tells nonsense, if it does
    double next_try_ = never;      ///< s, simulated; when a device that failed is tried again
    double last_news_ = 0;         ///< s, simulated; when the device's state was a new one
    double last_state_time_ = std::numeric_limits<double>::quiet_NaN(); ///< s; of the last state, by the device
    double last_answer_ = never;                                        ///< s, simulated
};
} // namespace ode_predictive_space::haptics

#endif
