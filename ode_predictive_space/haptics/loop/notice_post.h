// Queues of notices from the threads of a loop to the program. One thread delivers them, so that posting never waits.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_POST_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_POST_H

#include "ode_predictive_space/haptics/exchange.h"
#include "ode_predictive_space/haptics/safety.h"

#include <array>
#include <exception>

namespace ode_predictive_space::haptics
{
class NoticePost
{
public:
    enum class Side
    {
        servo,
        scene, ///< of a decoupled loop
        watch,
        clock
    };

    explicit NoticePost(NoticeSink sink) : sink_(std::move(sink)) {}

    /// Neither allocates nor waits. Drops the notice when a hundred of this side are queued.
    void post(const Notice &notice, Side side) { posted_[static_cast<std::size_t>(side)].give(notice); }

    void deliver_all()
    {
        for (Queue<Notice> &queue : posted_)
        {
            Notice notice;
            while (queue.receive(notice))
                deliver(notice);
        }
    }

    /// Whether the sink threw, after which it is not called. From any thread.
    bool sink_failed() const { return sink_failed_.load(std::memory_order_acquire); }

    std::exception_ptr sink_error() const { return sink_error_; }

private:
    void deliver(const Notice &notice)
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

    static constexpr std::size_t most_notices = 100; ///< per side

    NoticeSink sink_;
    std::array<Queue<Notice>, 4> posted_ = {Queue<Notice>(most_notices), Queue<Notice>(most_notices),
                                            Queue<Notice>(most_notices), Queue<Notice>(most_notices)}; ///< by side
    std::atomic<bool> sink_failed_{false};
    std::exception_ptr sink_error_;
};
} // namespace ode_predictive_space::haptics

#endif
