#include "ode_predictive_space/haptics/safety/open_gates.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <sys/time.h>
#include <unistd.h>

namespace ode_predictive_space::haptics::open_gates
{
namespace
{
/// A slot for a gate. Never freed, because a handler may be reading it.
struct Place
{
    std::atomic<DeviceGate *> gate{nullptr};
    std::atomic<int> visitors{0};
    std::atomic<std::thread::id> shut_by{}; ///< the last thread that shut the gate
    Place *next = nullptr;
};

std::atomic<Place *> first_place{nullptr};
std::mutex changes; // guards changes. No driver is called under it, and no handler takes it

thread_local int visits = 0; // nested visits of this thread

constexpr std::chrono::microseconds between_looks(100);

/// remove() waits for the visitors of a gate.
template <typename Visit> void visit_all(const Visit &visit) noexcept
{
    ++visits;
    for (Place *place = first_place; place != nullptr; place = place->next)
    {
        ++place->visitors;
        if (DeviceGate *const gate = place->gate)
            visit(*gate, *place);
        --place->visitors;
    }
    --visits;
}

/// The first slot whose gate, or 0, satisfies the predicate; otherwise 0.
template <typename Predicate> Place *find_place(const Predicate &is_it) noexcept
{
    Place *place = first_place;
    while (place != nullptr && !is_it(place->gate.load()))
        place = place->next;
    return place;
}

Place &free_place()
{
    if (Place *const free = find_place([](const DeviceGate *gate) { return gate == nullptr; }))
        return *free;
    auto *const place = new Place;
    place->next = first_place;
    first_place = place;
    return *place;
}

/// @return false when the device has a gate already.
bool try_add(DeviceGate &gate)
{
    const std::lock_guard<std::mutex> lock(changes);
    if (find_place([&](const DeviceGate *other) { return other != nullptr && &other->device() == &gate.device(); }))
        return false;
    Place &place = free_place();
    place.shut_by = std::thread::id();
    place.gate = &gate;
    return true;
}

bool is_empty() noexcept
{
    bool empty = true;
    visit_all([&](const DeviceGate &, const Place &) { empty = false; });
    return empty;
}

std::atomic<bool> is_installed{false};
std::terminate_handler earlier_terminate_handler = nullptr;
struct sigaction earlier_abort_action;

void notify(std::string_view sentence) noexcept
{
    if (write(STDERR_FILENO, sentence.data(), sentence.size()) < 0)
        return; // nothing else can be done
}

extern "C" void kill_hanging_program(int number)
{
    notify("ode_predictive_space: The program hangs in the device's driver at its end, and is killed. "
           "The device may keep its last force: switch it off.\n");
    raise(number); // which has its default action now
}

/// Runs the work; SIGALRM kills the program after a second.
template <typename Work> void within_a_second(const Work &work) noexcept
{
    struct sigaction action = {};
    struct sigaction earlier_action = {};
    action.sa_handler = &kill_hanging_program;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGALRM, &action, &earlier_action);
    sigset_t alarm;
    sigset_t earlier_mask;
    sigemptyset(&alarm);
    sigaddset(&alarm, SIGALRM);
    pthread_sigmask(SIG_UNBLOCK, &alarm, &earlier_mask);
    const itimerval second = {{0, 0}, {1, 0}};
    itimerval earlier_timer = {};
    setitimer(ITIMER_REAL, &second, &earlier_timer);
    work();
    setitimer(ITIMER_REAL, &earlier_timer, nullptr);
    pthread_sigmask(SIG_SETMASK, &earlier_mask, nullptr);
    sigaction(SIGALRM, &earlier_action, nullptr);
}

void end_forces_and_terminate()
{
    end_all_forces();
    if (earlier_terminate_handler != nullptr)
        earlier_terminate_handler();
    std::abort();
}

/// abort() runs in the calling thread, so the rules of a terminate handler apply.
extern "C" void end_forces_and_abort(int number)
{
    if (!is_empty())
    {
        end_all_forces();
        notify("ode_predictive_space: The program aborts: no force any more.\n");
    }
    sigaction(SIGABRT, &earlier_abort_action, nullptr);
    raise(number);
}

void guard_program_end() noexcept
{
    if (is_installed.exchange(true))
        return;
    std::atexit(&end_all_forces);
    std::at_quick_exit(&end_all_forces);
    earlier_terminate_handler = std::set_terminate(&end_forces_and_terminate);
    struct sigaction action = {};
    action.sa_handler = &end_forces_and_abort;
    sigaction(SIGABRT, &action, &earlier_abort_action);
}
} // namespace

void add(DeviceGate &gate)
{
    guard_program_end();
    if (!try_add(gate)) // without the mutex: a terminate handler may destroy other probes
        throw std::logic_error("Another probe renders to this device; a device can have one probe");
}

void remove(DeviceGate &gate) noexcept
{
    Place *place = nullptr;
    {
        const std::lock_guard<std::mutex> lock(changes);
        place = find_place([&](const DeviceGate *known) { return known == &gate; });
        if (place != nullptr)
            place->gate = nullptr;
    }
    // A driver in this thread may have called exit(), which destroys the probe; such a visit never ends.
    while (place != nullptr && visits == 0 && place->visitors != 0)
        std::this_thread::sleep_for(between_looks);
}

bool close_unguarded(std::thread::id reader, double now) noexcept
{
    bool any = false;
    visit_all([&](DeviceGate &gate, const Place &) {
        if (gate.is_guarded() || gate.reader() != reader)
            return;
        any = true;
        try
        {
            gate.close_with_zero(now);
        }
        catch (...)
        {
            // the device was closed
        }
    });
    return any;
}

void end_all_forces() noexcept
{
    if (is_empty())
        return;
    within_a_second([] {
        visit_all([me = std::this_thread::get_id()](DeviceGate &gate, Place &place) {
            // A driver that ends the program in this call is not called again.
            if (place.shut_by.exchange(me) != me)
                gate.shut();
        });
    });
}
} // namespace ode_predictive_space::haptics::open_gates
