#include "ode_predictive_space/haptics/loop/contact_model.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
void ContactModel::set(const std::vector<Touch> &touches, bool all_known, const Vector3 &tool, double time)
{
    const auto end = std::partial_sort_copy(touches.begin(), touches.end(), touches_.begin(), touches_.end(),
                                            [](const Touch &a, const Touch &b) { return a.depth > b.depth; });
    count_ = static_cast<std::size_t>(end - touches_.begin());
    all_known_ = all_known;
    tool_ = tool;
    time_ = time;
}

void ContactModel::evaluate(const Vector3 &tool, double time, const Shifts &shifts, std::vector<Touch> &touches) const
{
    touches.clear();
    const Vector3 moved = tool - tool_;
    for (std::size_t i = 0; i < count_; ++i)
    {
        Touch touch = touches_[i];
        if (touch.from_entry_side)
            continue; // the servo has the geom itself
        const Vector3 carried = (time - time_) * touch.surface_velocity + shifts[i].moved_at(touch.point);
        touch.depth -= touch.normal.dot(moved - carried);
        if (touch.depth <= 0)
            continue;
        // The contact goes with the tool along the surface, and with the surface along the normal.
        touch.point += moved - touch.normal * touch.normal.dot(moved - carried);
        touch.surface_velocity += shifts[i].velocity_at(touches_[i].point);
        touches.push_back(touch);
    }
}
} // namespace ode_predictive_space::haptics
