// Gives notices to the program, and no topic too often.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_DESK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_DESK_H

#include "ode_predictive_space/haptics/safety.h"

namespace ode_predictive_space::haptics
{
/// In a catch block: the sentence, which has no end yet, with what the exception says, if that is a std::exception.
std::string with_reason(const std::string &sentence);

/// Of one topic, one notice a second: those in between are held back, and told later as one, with their number.
class NoticeDesk
{
public:
    static constexpr std::size_t most_topics = 20;

    explicit NoticeDesk(NoticeSink sink);

    void set_sink(NoticeSink sink) { sink_ = std::move(sink); }
    const NoticeSink &sink() const { return sink_; }

    /// A tick begins. @param time s, simulated.
    void set_time(double time) { time_ = time; }

    void tell(NoticeKind kind, std::string_view sentence) const;

    /// @param topic below most_topics.
    void tell_once_a_second(std::size_t topic, NoticeKind kind, std::string_view sentence);

    /// What was held back of the topics that have been quiet for so long, in s. At the end of a run: for no time.
    void tell_held_back(double quiet_for = tell_again_after);

    /// How many notices were held back, so far.
    std::uint64_t held_back() const { return held_back_; }

private:
    static constexpr double tell_again_after = 1; ///< s

    /// What was told of a topic, and what was not.
    struct Told
    {
        double last;   ///< s, simulated; when it was told
        int times = 0; ///< held back since
        Notice notice; ///< the last of those
    };

    NoticeSink sink_;
    double time_ = 0; ///< s, simulated
    std::array<Told, most_topics> told_;
    std::uint64_t held_back_ = 0;
};
} // namespace ode_predictive_space::haptics

#endif
