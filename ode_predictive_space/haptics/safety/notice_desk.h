// Gives notices to the program, and no topic too often.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_DESK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_DESK_H

#include "ode_predictive_space/haptics/safety.h"

namespace ode_predictive_space::haptics
{
/// In a catch block: the sentence, which has no end yet, with what the exception says, if that is a std::exception.
std::string with_reason(const std::string &sentence);

/// One notice a second on each topic.
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

private:
    static constexpr double tell_again_after = 1; ///< s

    NoticeSink sink_;
    double time_ = 0;                      ///< s, simulated
    std::array<double, most_topics> last_; ///< s, simulated; when each topic was reported
};
} // namespace ode_predictive_space::haptics

#endif
