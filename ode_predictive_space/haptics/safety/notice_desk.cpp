#include "ode_predictive_space/haptics/safety/notice_desk.h"

#include <algorithm>
#include <cstdio>
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
    told_.fill({-std::numeric_limits<double>::infinity(), 0, {}});
}

void NoticeDesk::tell(NoticeKind kind, std::string_view sentence) const
{
    if (sink_)
        sink_(Notice(kind, time_, sentence));
}

void NoticeDesk::tell_once_a_second(std::size_t topic, NoticeKind kind, std::string_view sentence)
{
    Told &told = told_[topic];
    if (time_ - told.last >= tell_again_after)
    {
        told.last = time_;
        tell(kind, sentence);
        return;
    }
    ++told.times;
    ++held_back_;
    told.notice = Notice(kind, time_, sentence);
}

void NoticeDesk::tell_held_back(double quiet_for)
{
    for (Told &told : told_)
    {
        if (told.times == 0 || time_ - told.last < quiet_for)
            continue;
        std::array<char, std::tuple_size_v<decltype(Notice::text)>> text;
        std::snprintf(text.data(), text.size(), "%s (%d more times, the last at %.3f s)", told.notice.text.data(),
                      told.times, told.notice.time);
        told.times = 0;
        told.last = time_;
        tell(told.notice.kind, text.data());
    }
}
} // namespace ode_predictive_space::haptics
