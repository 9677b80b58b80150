// Notices to the program, at most one a second for each topic.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_DESK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_DESK_H

#include "ode_predictive_space/haptics/safety.h"

namespace ode_predictive_space::haptics
{
/// For a catch block: appends the text of a std::exception to the sentence, which has no full stop.
std::string with_reason(const std::string &sentence);

class NoticeDesk
{
public:
    static constexpr std::size_t most_topics = 20;

    explicit NoticeDesk(NoticeSink sink);

    void set_sink(NoticeSink sink) { sink_ = std::move(sink); }
    const NoticeSink &sink() const { return sink_; }

    void set_time(double time) { time_ = time; }

    void notify(NoticeKind kind, std::string_view sentence) const;

    void notify_once_a_second(std::size_t topic, NoticeKind kind, std::string_view sentence);

private:
    static constexpr double notify_again_after = 1; ///< s

    NoticeSink sink_;
    double time_ = 0;                      ///< s, simulated
    std::array<double, most_topics> last_; ///< s, simulated; when each topic was reported
};
} // namespace ode_predictive_space::haptics

#endif
