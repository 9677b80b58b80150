#include "ode_predictive_space/haptics/safety/open_gates.h"

#include "ode_predictive_space/haptics/safety/program_end.h"

#include <chrono>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace ode_predictive_space::haptics::open_gates
{
namespace
{
/// Of one gate at a time. Never freed: a handler may be reading it.
struct Place
{
    std::atomic<DeviceGate *> gate{nullptr};
    std::atomic<int> visitors{0};
    std::atomic<std::thread::id> shut_by{}; ///< the last thread that did it
    Place *next = nullptr;
};

std::atomic<Place *> first_place{nullptr};
std::mutex changes; // of gates. Nothing throws and no driver is called while it is locked; no handler takes it

thread_local int visits = 0; // of this thread, one within another

constexpr std::chrono::microseconds between_looks(100);

/// The gate stays while it is visited: remove() waits for its visitors.
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

Place *place_of(const DeviceGate *gate) noexcept
{
    Place *place = first_place;
    while (place != nullptr && place->gate != gate)
        place = place->next;
    return place;
}

bool is_taken(const Device &device) noexcept
{
    bool taken = false;
    for (const Place *place = first_place; place != nullptr; place = place->next)
    {
        const DeviceGate *const gate = place->gate;
        taken = taken || (gate != nullptr && &gate->device() == &device);
    }
    return taken;
}

/// @param unused a place, for when no other is free. @return false when the device is taken.
bool put(DeviceGate &gate, std::unique_ptr<Place> unused) noexcept
{
    const std::lock_guard<std::mutex> lock(changes);
    if (is_taken(gate.device()))
        return false;
    if (Place *const free = place_of(nullptr))
    {
        free->shut_by = std::thread::id();
        free->gate = &gate;
        return true;
    }
    unused->gate = &gate;
    unused->next = first_place;
    first_place = unused.release();
    return true;
}
} // namespace

void add(DeviceGate &gate)
{
    guard_program_end();
    if (!put(gate, std::make_unique<Place>()))
        throw std::logic_error("Another probe renders to this device: one of them would have no guard");
}

void remove(DeviceGate &gate) noexcept
{
    Place *place = nullptr;
    {
        const std::lock_guard<std::mutex> lock(changes);
        place = place_of(&gate);
        if (place != nullptr)
            place->gate = nullptr;
    }
    // A driver that this thread visits may have called exit(), which destroys the probe: such a visit never ends.
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
            // it was closed
        }
    });
    return any;
}

bool is_empty() noexcept
{
    bool empty = true;
    visit_all([&](const DeviceGate &, const Place &) { empty = false; });
    return empty;
}

void shut_all() noexcept
{
    visit_all([me = std::this_thread::get_id()](DeviceGate &gate, Place &place) {
        // A driver that ends the program in this very call, too, is not called again.
        if (place.shut_by.exchange(me) != me)
            gate.shut();
    });
}
} // namespace ode_predictive_space::haptics::open_gates
