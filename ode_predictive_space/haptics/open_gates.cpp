#include "ode_predictive_space/haptics/open_gates.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace ode_predictive_space::haptics::open_gates
{
namespace
{
struct Registry
{
    std::mutex mutex;
    std::vector<DeviceGate *> gates;
    bool installed = false;
};

/// Never destroyed: it is needed while the program's statics are.
Registry &registry()
{
    static Registry &instance = *new Registry;
    return instance;
}

std::terminate_handler earlier_terminate_handler = nullptr;

void shut_all_and_terminate()
{
    shut_all();
    if (earlier_terminate_handler != nullptr)
    {
        earlier_terminate_handler();
    }
    std::abort();
}

void install()
{
    std::atexit(&shut_all);
    std::at_quick_exit(&shut_all);
    earlier_terminate_handler = std::set_terminate(&shut_all_and_terminate);
}
} // namespace

void add(DeviceGate &gate)
{
    Registry &all = registry();
    const std::lock_guard<std::mutex> lock(all.mutex);
    for (const DeviceGate *other : all.gates)
    {
        if (&other->device() == &gate.device())
        {
            throw std::logic_error("Another probe renders to this device: one of them would have no guard");
        }
    }
    if (!all.installed)
    {
        install();
        all.installed = true;
    }
    all.gates.push_back(&gate);
}

void remove(DeviceGate &gate) noexcept
{
    Registry &all = registry();
    const std::lock_guard<std::mutex> lock(all.mutex);
    all.gates.erase(std::remove(all.gates.begin(), all.gates.end(), &gate), all.gates.end());
}

bool close_unguarded(std::thread::id reader, double now) noexcept
{
    bool any = false;
    Registry &all = registry();
    const std::lock_guard<std::mutex> lock(all.mutex);
    for (DeviceGate *gate : all.gates)
    {
        if (gate->is_guarded() || gate->reader() != reader)
        {
            continue;
        }
        any = true;
        try
        {
            gate->close_with_zero(now);
        }
        catch (...)
        {
            // it was closed
        }
    }
    return any;
}

void shut_all() noexcept
{
    Registry &all = registry();
    const std::lock_guard<std::mutex> lock(all.mutex);
    for (DeviceGate *gate : all.gates)
    {
        gate->shut();
    }
}
} // namespace ode_predictive_space::haptics::open_gates
