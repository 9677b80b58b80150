#include "ode_predictive_space/haptics/loop/notice_speaker.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double speaker_period = 0.01; // s
} // namespace

void NoticeSpeaker::start(LoopClock &clock)
{
    task_ = clock.start({speaker_period, {}, [this](double) { deliver_all(); }});
}

void NoticeSpeaker::end()
{
    task_.reset();
    deliver_all();
}

void NoticeSpeaker::deliver_all()
{
    for (Queue<Notice> &queue : posted_)
    {
        Notice notice;
        while (queue.receive(notice))
            deliver(notice);
    }
}

void NoticeSpeaker::deliver(const Notice &notice)
{
    if (!sink_ || sink_failed())
        return;
    try
    {
        sink_(notice);
    }
    catch (...)
    {
        sink_error_ = std::current_exception();
        sink_failed_.store(true, std::memory_order_release);
    }
}
} // namespace ode_predictive_space::haptics
