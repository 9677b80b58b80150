// Objects that the tool was in when the clutch was released.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RISING_OBJECTS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RISING_OBJECTS_H

#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/touch.h"

#include <algorithm>
#include <vector>

namespace ode_predictive_space::haptics
{
/// While the clutch is held, there is no force on the hand, so that after it each of these objects pushes as hard as it is deep, at once.
/// Its force rises instead from zero within half a second, with its own normal; other objects are felt in full.
class RisingObjects
{
public:
    RisingObjects() { objects_.reserve(touch_capacity); }

    /// One tick.
    ///
    /// @param released whether the clutch was released in this tick.
    /// @param dt s; since the tick before.
    /// @param touches solved; those of rising objects become less.
    void follow(bool released, double dt, std::vector<Touch> &touches)
    {
        remove_from(objects_, [&](const Object &object) {
            return released || object.part == 1 ||
                   find_in(touches, [&](const Touch &touch) { return touch.object == object.id; }) == nullptr;
        });
        for (Object &object : objects_)
            object.part = std::min(1.0, object.part + dt / rise_time);
        for (Touch &touch : touches)
        {
            Object *object = find_in(objects_, [&](const Object &other) { return other.id == touch.object; });
            if (object == nullptr && released)
                object = &objects_.emplace_back(Object{touch.object, 0});
            if (object != nullptr)
                make_less(touch, object->part);
        }
    }

    /// All objects are felt in full.
    void reset() { objects_.clear(); }

private:
    static constexpr double rise_time = 0.5; // s

    struct Object
    {
        std::uintptr_t id; ///< Touch::object
        double part;       ///< 0 to 1; that is felt
    };

    static void make_less(Touch &touch, double part)
    {
        touch.depth *= part;
        touch.part *= part;
        touch.carry.share *= part;
        touch.carry.lag *= part;
    }

    std::vector<Object> objects_;
};
} // namespace ode_predictive_space::haptics

#endif
