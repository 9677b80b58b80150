// Hands the notices of a loop's threads to the program.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_SPEAKER_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_SPEAKER_H

#include "ode_predictive_space/haptics/exchange.h"
#include "ode_predictive_space/haptics/loop.h"

#include <exception>

namespace ode_predictive_space::haptics
{
/// Calls the program's sink in a thread of its own, so that no servo has to wait for a terminal.
class NoticeSpeaker
{
public:
    /// Who posts: each from one thread.
    enum class Side
    {
        servo,
        scene,
        watch,
        count
    };

    /// @param sink may be empty.
    explicit NoticeSpeaker(NoticeSink sink) : sink_(std::move(sink)) {}

    void start(LoopClock &clock);

    /// Of the thread that started it: what was posted is delivered.
    void end();

    /// Neither allocates nor waits. Lost when a hundred others of this side are on their way.
    void post(Side side, const Notice &notice) { posted_[static_cast<std::size_t>(side)].give(notice); }

    /// Whether the sink threw; it is not called any more, then. From any thread.
    bool sink_failed() const { return sink_failed_.load(std::memory_order_acquire); }

    /// What it threw. After sink_failed().
    std::exception_ptr sink_error() const { return sink_error_; }

private:
    static constexpr std::size_t most_notices = 100; ///< on their way

    void deliver_all();
    void deliver(const Notice &notice);

    NoticeSink sink_;
    Queue<Notice> posted_[static_cast<std::size_t>(Side::count)] = {
        Queue<Notice>(most_notices), Queue<Notice>(most_notices), Queue<Notice>(most_notices)};
    std::atomic<bool> sink_failed_{false};
    std::exception_ptr sink_error_;
    std::unique_ptr<RunningTask> task_; ///< last: it uses the others
};
} // namespace ode_predictive_space::haptics

#endif
