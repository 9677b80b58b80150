#include "demos/haptic/foretelling.h"

#include <algorithm>

namespace ode_predictive_space::demo
{
void Foretelling::foretold(double time, const std::vector<Foretold> &meetings)
{
    std::map<std::uintptr_t, Approach> now;
    for (const Foretold &meeting : meetings)
    {
        const auto known = approaches_.find(meeting.object);
        now[meeting.object] =
            known != approaches_.end() ? known->second : Approach{time, time + meeting.seconds, meeting.seconds > 0};
    }
    approaches_ = std::move(now);
}

void Foretelling::touching(double time, const std::vector<std::uintptr_t> &objects)
{
    for (const std::uintptr_t object : objects)
    {
        if (std::find(touched_.begin(), touched_.end(), object) == touched_.end())
        {
            count(time, object);
        }
    }
    touched_ = objects;
}

void Foretelling::count(double time, std::uintptr_t object)
{
    ++touches_;
    const auto approach = approaches_.find(object);
    if (approach != approaches_.end() && approach->second.in_time)
    {
        ++foretold_;
        notice_sum_ += time - approach->second.first_seen;
        early_sum_ += time - approach->second.earliest;
    }
}

ForetellingReport Foretelling::report() const
{
    const double count = foretold_ > 0 ? static_cast<double>(foretold_) : 1;
    return {touches_, foretold_, notice_sum_ / count, early_sum_ / count};
}
} // namespace ode_predictive_space::demo
