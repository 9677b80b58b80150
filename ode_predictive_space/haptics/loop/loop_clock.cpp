#include "ode_predictive_space/haptics/loop.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <ctime>
#include <limits>
#include <thread>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double nanoseconds_per_second = 1e9;

double next_time(double due, double period, double now)
{
    return due + period * std::max(1.0, std::floor((now - due) / period) + 1);
}

class ThreadTask : public RunningTask
{
public:
    ThreadTask(MonotonicClock &clock, PeriodicTask task)
        : clock_(clock), task_(std::move(task)), thread_([this] { run(); })
    {}

    ~ThreadTask() override
    {
        ended_.store(true);
        thread_.join();
    }

private:
    void run()
    {
        if (task_.prepare)
            task_.prepare();
        double due = clock_.now() + task_.period;
        while (!ended_.load())
        {
            clock_.sleep_until(due);
            if (!ended_.load())
                task_.carry_out(due);
            due = next_time(due, task_.period, clock_.now());
        }
    }

    MonotonicClock &clock_;
    PeriodicTask task_;
    std::atomic<bool> ended_{false};
    std::thread thread_; ///< last, because it uses the others
};
} // namespace

double MonotonicClock::now() const
{
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / nanoseconds_per_second;
}

void MonotonicClock::sleep_until(double time)
{
    const double seconds = std::floor(time);
    timespec deadline{};
    deadline.tv_sec = static_cast<time_t>(seconds);
    deadline.tv_nsec = static_cast<long>((time - seconds) * nanoseconds_per_second);
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR)
    {}
}

std::unique_ptr<RunningTask> MonotonicClock::start(PeriodicTask task)
{
    return std::make_unique<ThreadTask>(*this, std::move(task));
}

class SimulatedClock::Entry : public RunningTask
{
public:
    Entry(SimulatedClock &clock, PeriodicTask task)
        : clock_(clock), task_(std::move(task)), due_(clock.now() + task_.period)
    {
        clock_.entries_.push_back(this);
        if (task_.prepare)
            task_.prepare();
    }

    ~Entry() override { clock_.entries_.erase(std::find(clock_.entries_.begin(), clock_.entries_.end(), this)); }

    /// s; infinite while the task runs.
    double due() const { return busy_ ? std::numeric_limits<double>::infinity() : due_; }

    void carry_out()
    {
        busy_ = true;
        task_.carry_out(due_);
        busy_ = false;
        due_ = next_time(due_, task_.period, clock_.now());
    }

private:
    SimulatedClock &clock_;
    PeriodicTask task_;
    double due_; ///< s
    bool busy_ = false;
};

SimulatedClock::SimulatedClock() = default;
SimulatedClock::~SimulatedClock() = default;

double SimulatedClock::now() const
{
    return now_;
}

void SimulatedClock::sleep_until(double time)
{
    while (Entry *entry = next_due(time))
        carry_out(*entry);
    now_ = std::max(now_, time);
}

void SimulatedClock::advance(double seconds)
{
    sleep_until(now_ + seconds);
}

SimulatedClock::Entry *SimulatedClock::next_due(double until) const
{
    const auto first = std::min_element(entries_.begin(), entries_.end(),
                                        [](const Entry *a, const Entry *b) { return a->due() < b->due(); });
    return first != entries_.end() && (*first)->due() <= until ? *first : nullptr;
}

void SimulatedClock::carry_out(Entry &entry)
{
    now_ = std::max(now_, entry.due());
    entry.carry_out();
}

std::unique_ptr<RunningTask> SimulatedClock::start(PeriodicTask task)
{
    return std::make_unique<Entry>(*this, std::move(task));
}
} // namespace ode_predictive_space::haptics
