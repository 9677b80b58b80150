#include "ode_predictive_space/haptics/safety/notice_desk.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ode_predictive_space::haptics
{
Notice::Notice(NoticeKind notice_kind, double notice_time, std::string_view sentence)
    : kind(notice_kind), time(notice_time)
{
    const std::size_t length = std::min(sentence.size(), text.size() - 1);
    std::copy_n(sentence.begin(), length, text.begin());
}

std::string with_reason(const std::string &sentence)
{
    try
    {
        throw;
    }
    catch (const std::exception &error)
    {
        return sentence + ": " + error.what();
    }
    catch (...)
    {
        return sentence + ".";
    }
}

NoticeDesk::NoticeDesk(NoticeSink sink) : sink_(std::move(sink))
{
    last_.fill(-std::numeric_limits<double>::infinity());
}

void NoticeDesk::notify(NoticeKind kind, std::string_view sentence) const
{
    if (sink_)
        sink_(Notice(kind, time_, sentence));
}

void NoticeDesk::notify_once_a_second(std::size_t topic, NoticeKind kind, std::string_view sentence)
{
    if (time_ - last_[topic] < notify_again_after)
        return;
    last_[topic] = time_;
    notify(kind, sentence);
}
} // namespace ode_predictive_space::haptics
