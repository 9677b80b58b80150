#include "ode_predictive_space/haptics/contact/other_probes.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

#include <mutex>

namespace ode_predictive_space::haptics
{
namespace
{
std::mutex tools_mutex;

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
    self_ = tool;
    const std::lock_guard<std::mutex> lock(tools_mutex);
    if (ProbeTool *known = find_in(tools(), [this](const ProbeTool &other) { return other.owner == this; }))
        *known = tool;
    else
        tools().push_back(tool);
}

void OtherProbes::leave()
{
    if (self_.owner == nullptr)
        return;
    self_ = ProbeTool();
    const std::lock_guard<std::mutex> lock(tools_mutex);
    remove_from(tools(), [this](const ProbeTool &other) { return other.owner == this; });
}

const std::vector<ProbeTool> &OtherProbes::near()
{
    near_.clear();
    const std::lock_guard<std::mutex> lock(tools_mutex);
    for (const ProbeTool &other : tools())
        if (self_.owner != nullptr && may_touch(self_, other))
            near_.push_back(other);
    return near_;
}

dGeomID OtherProbes::sphere_of(dGeomID region)
{
    const std::lock_guard<std::mutex> lock(tools_mutex);
    const ProbeTool *found = find_in(tools(), [&](const ProbeTool &other) { return other.region == region; });
    return found != nullptr ? found->sphere : nullptr;
}
} // namespace ode_predictive_space::haptics
