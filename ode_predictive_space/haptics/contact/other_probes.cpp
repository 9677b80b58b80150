#include "ode_predictive_space/haptics/contact/other_probes.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

#include <atomic>
#include <mutex>

namespace ode_predictive_space::haptics
{
namespace
{
std::mutex tools_mutex;
std::atomic<std::uint64_t> tools_version{0};

/// Never destroyed, because probes can be static objects.
std::vector<ProbeTool> &tools()
{
    static auto *const tools = new std::vector<ProbeTool>;
    return *tools;
}

bool may_touch(const ProbeTool &a, const ProbeTool &b)
{
    return a.owner != b.owner && a.scene == b.scene &&
           ((a.category & b.collides) != 0 || (b.category & a.collides) != 0);
}
} // namespace

void OtherProbes::announce(ProbeTool tool)
{
    tool.owner = this;
    const bool is_new = self_.owner == nullptr;
    self_ = tool;
    std::unique_lock<std::mutex> lock(tools_mutex, std::defer_lock);
    if (is_new)
        lock.lock();
    else if (!lock.try_lock())
        return;
    ProbeTool *known = find_in(tools(), [this](const ProbeTool &other) { return other.owner == this; });
    if (known != nullptr)
        *known = tool;
    else
        tools().push_back(tool);
    tools_version += is_new ? 1 : 0;
}

void OtherProbes::leave()
{
    if (self_.owner == nullptr)
        return;
    self_ = ProbeTool();
    const std::lock_guard<std::mutex> lock(tools_mutex);
    remove_from(tools(), [this](const ProbeTool &other) { return other.owner == this; });
    ++tools_version;
}

void OtherProbes::take_list()
{
    version_ = tools_version;
    all_ = tools();
}

void OtherProbes::update()
{
    std::unique_lock<std::mutex> lock(tools_mutex, std::defer_lock);
    if (version_ != tools_version)
        lock.lock();
    if (lock.owns_lock() || lock.try_lock())
        take_list();
    near_.clear();
    for (const ProbeTool &other : all_)
        if (self_.owner != nullptr && may_touch(self_, other))
            near_.push_back(other);
}

const ProbeTool *OtherProbes::find(dGeomID region)
{
    if (version_ != tools_version)
    {
        const std::lock_guard<std::mutex> lock(tools_mutex);
        take_list();
    }
    return find_in(all_, [&](const ProbeTool &other) { return other.region == region; });
}
} // namespace ode_predictive_space::haptics
