// The servo's model of the scene between two steps.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MODEL_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MODEL_H

#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/touch.h"

#include <algorithm>
#include <array>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The motion of an object beyond that by its constant velocity.
struct Shift
{
    std::uintptr_t object = 0;          ///< as Touch has it
    Vector3 moved = Vector3::Zero();    ///< m; its centre of mass
    Vector3 velocity = Vector3::Zero(); ///< m/s; of that
    Vector3 turned = Vector3::Zero();   ///< rad; the vector of a rotation about the centre
    Vector3 spin = Vector3::Zero();     ///< rad/s
    Vector3 centre = Vector3::Zero();   ///< m; before that

    Vector3 moved_at(const Vector3 &point) const { return moved + turned.cross(point - centre); }
    Vector3 velocity_at(const Vector3 &point) const { return velocity + spin.cross(point - centre); }
};

using Shifts = std::array<Shift, 8>;

/// The shift of an object, by its deepest touch; zero for an object without a prediction.
inline Shift shift_of(std::uintptr_t object, const Shifts &shifts)
{
    const Shift *const found = find_in(shifts, [object](const Shift &shift) { return shift.object == object; });
    return found != nullptr ? *found : Shift();
}

/// The touched surfaces as moving planes, one for each touch of the last collision. It has a fixed size, to be passed
/// between threads; its cost does not depend on the scene.
///
/// A plane moves with the surface's velocity at the contact and with the predicted shift of its object. The depth
/// changes with the tool's motion along the normal, which is exact for a flat surface while the probe does not turn.
class ContactModel
{
public:
    void set(const std::vector<Touch> &touches, bool all_known, const Vector3 &tool, double time)
    {
        const auto end = std::partial_sort_copy(touches.begin(), touches.end(), touches_.begin(), touches_.end(),
                                                [](const Touch &a, const Touch &b) { return a.depth > b.depth; });
        count_ = static_cast<std::size_t>(end - touches_.begin());
        all_known_ = all_known;
        tool_ = tool;
        time_ = time;
    }

    /// The touches of the probe at another place and time. Touches of geoms that the servo has itself (from_entry_side)
    /// are left out.
    ///
    /// @param touches result: those with a depth above 0.
    void evaluate(const Vector3 &tool, double time, const Shifts &shifts, std::vector<Touch> &touches) const
    {
        touches.clear();
        const Vector3 moved = tool - tool_;
        for (std::size_t i = 0; i < count_; ++i)
        {
            Touch touch = touches_[i];
            if (touch.from_entry_side)
                continue;
            const Shift shift = shift_of(touch.object, shifts);
            const Vector3 carried = (time - time_) * touch.surface_velocity + shift.moved_at(touch.point);
            touch.depth -= touch.normal.dot(moved - carried);
            if (touch.depth <= 0)
                continue;
            touch.surface_velocity += shift.velocity_at(touch.point);
            // The contact goes with the tool along the surface, and with the surface along the normal.
            const Vector3 went = moved - touch.normal * touch.normal.dot(moved - carried);
            touch.point += went;
            touch.arm += went - carried;
            touches.push_back(touch);
        }
    }

    std::size_t count() const { return count_; }
    const Touch &touch(std::size_t index) const { return touches_[index]; }
    bool all_known() const { return all_known_; }

private:
    std::array<Touch, touch_capacity> touches_;
    std::size_t count_ = 0;
    bool all_known_ = true;
    Vector3 tool_ = Vector3::Zero();
    double time_ = 0;
};
} // namespace ode_predictive_space::haptics

#endif
