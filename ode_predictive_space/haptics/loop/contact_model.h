// What the servo knows of the scene between two steps of it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MODEL_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MODEL_H

#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/touch.h"

#include <algorithm>
#include <array>
#include <vector>

namespace ode_predictive_space::haptics
{
/// What an object did besides going on with its velocity.
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

/// One for each touch that is foreseen, the deepest first.
using Shifts = std::array<Shift, 8>;

/// The deepest touch says how far the whole object has gone. @return none for an object that is not foreseen.
inline Shift shift_of(std::uintptr_t object, const Shifts &shifts)
{
    const Shift *const found = find_in(shifts, [object](const Shift &shift) { return shift.object == object; });
    return found != nullptr ? *found : Shift();
}

/// The surfaces around the probe as planes that move: one for each touch, as it was when the scene was looked at last. Of
/// fixed size, to be handed from thread to thread; what it costs does not depend on the scene.
///
/// A plane moves with the velocity that the surface had at the contact, and by what else was forecast of its object. Depth changes by
/// how the tool moves along the normal: that is exact for a flat surface, whatever the shape of the probe, as long as the probe does not
/// turn.
class ContactModel
{
public:
    /// @param touches as TouchSensor tells them, those with a negative depth included.
    /// @param all_known whether these are all.
    /// @param tool m, the scene's frame; where the probe was.
    /// @param time s; when this was so.
    void set(const std::vector<Touch> &touches, bool all_known, const Vector3 &tool, double time)
    {
        const auto end = std::partial_sort_copy(touches.begin(), touches.end(), touches_.begin(), touches_.end(),
                                                [](const Touch &a, const Touch &b) { return a.depth > b.depth; });
        count_ = static_cast<std::size_t>(end - touches_.begin());
        all_known_ = all_known;
        tool_ = tool;
        time_ = time;
    }

    /// What a probe touches that is at another place at another time. Touches from the side of entry are left out: they are
    /// those of geoms that the servo knows better.
    ///
    /// @param touches is overwritten: those whose depth is above 0.
    void evaluate(const Vector3 &tool, double time, const Shifts &shifts, std::vector<Touch> &touches) const
    {
        touches.clear();
        const Vector3 moved = tool - tool_;
        for (std::size_t i = 0; i < count_; ++i)
        {
            Touch touch = touches_[i];
            if (touch.from_entry_side)
                continue; // the servo has the geom itself
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
