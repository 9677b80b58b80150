#include "ode_predictive_space/haptics/safety/notice_desk.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double notify_again_after = 1;   // s
constexpr std::size_t most_sentences = 20; // more would allocate
} // namespace

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
    sent_.reserve(most_sentences);
}

void NoticeDesk::notify(NoticeKind kind, std::string_view sentence) const
{
    if (sink_)
        sink_(Notice(kind, time_, sentence));
}

void NoticeDesk::notify_once_a_second(NoticeKind kind, std::string_view sentence)
{
    auto last = std::find_if(sent_.begin(), sent_.end(), [&](const Sent &sent) { return sent.sentence == sentence; });
    if (last == sent_.end())
        last = sent_.insert(last, {sentence, -std::numeric_limits<double>::infinity()});
    if (time_ - last->time < notify_again_after)
        return;
    last->time = time_;
    notify(kind, sentence);
}
} // namespace ode_predictive_space::haptics
