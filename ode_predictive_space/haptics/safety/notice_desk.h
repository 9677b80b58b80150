// Notices to the program.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_DESK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_DESK_H

#include "ode_predictive_space/haptics/safety.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// For a catch block: appends the text of a std::exception to the sentence, which has no full stop.
std::string with_reason(const std::string &sentence);

class NoticeDesk
{
public:
    explicit NoticeDesk(NoticeSink sink);

    void set_sink(NoticeSink sink) { sink_ = std::move(sink); }
    const NoticeSink &sink() const { return sink_; }

    void set_time(double time) { time_ = time; }

    void notify(NoticeKind kind, std::string_view sentence) const;

    /// At most once a second for each sentence, a literal.
    void notify_once_a_second(NoticeKind kind, std::string_view sentence);

private:
    struct Sent
    {
        std::string_view sentence;
        double time; ///< s, simulated; of the last notice
    };

    NoticeSink sink_;
    double time_ = 0; ///< s, simulated
    std::vector<Sent> sent_;
};
} // namespace ode_predictive_space::haptics

#endif
