#include "ode_predictive_space/haptics/contact/numbered_touches.h"

#include "ode_predictive_space/haptics/contact/contact_manifold.h"
#include "ode_predictive_space/haptics/contact/short_list.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
bool has_feature(const std::vector<TouchOfGeom> &touches, std::uintptr_t object, unsigned number)
{
    return find_in(touches, [&](const TouchOfGeom &told) {
               return told.touch.object == object && told.touch.feature == number;
           }) != nullptr;
}

/// Numbers one touch of an object as in the tick before: the pair whose normals agree best.
bool recognise_one(const std::vector<TouchOfGeom> &before, std::uintptr_t object, std::vector<TouchOfGeom> &now)
{
    double best = same_surface;
    Touch *chosen = nullptr;
    unsigned number = 0;
    for (const TouchOfGeom &known : before)
    {
        if (known.touch.object != object || has_feature(now, object, known.touch.feature))
            continue;
        for (TouchOfGeom &told : now)
        {
            const double agreement = told.touch.normal.dot(known.touch.normal);
            if (told.touch.object == object && told.touch.feature == 0 && agreement > best)
            {
                best = agreement;
                chosen = &told.touch;
                number = known.touch.feature;
            }
        }
    }
    if (chosen != nullptr)
        chosen->feature = number;
    return chosen != nullptr;
}

double way_of(const Touch &touch)
{
    return (touch.carry.share * touch.normal + touch.carry.lag).norm();
}
} // namespace

NumberedTouches::NumberedTouches()
{
    now_.reserve(touch_capacity);
    before_.reserve(touch_capacity);
}

void NumberedTouches::renew()
{
    now_.swap(before_);
    now_.clear();
}

void NumberedTouches::forget()
{
    now_.clear();
    before_.clear();
}

void NumberedTouches::add_carriers_of_before(const Vector3 &lag)
{
    double sum = 0;
    for (const TouchOfGeom &carrier : before_)
        sum += way_of(carrier.touch);
    for (TouchOfGeom carrier : before_)
    {
        if (!carrier.touch.carry.carries())
            continue;
        const double part = way_of(carrier.touch) / sum;
        carrier.touch.carry = {0, part * lag};
        carrier.touch.depth = std::max(0.0, part * lag.dot(carrier.touch.normal));
        now_.push_back(carrier);
    }
}

/// A touch without a number has 0.
void NumberedTouches::number()
{
    for (const TouchOfGeom &told : now_)
        while (told.touch.feature == 0 && recognise_one(before_, told.touch.object, now_))
        {}
    for (TouchOfGeom &told : now_)
    {
        if (told.touch.feature != 0)
            continue;
        unsigned number = 1;
        while (has_feature(before_, told.touch.object, number) || has_feature(now_, told.touch.object, number))
            ++number;
        told.touch.feature = number;
    }
}
} // namespace ode_predictive_space::haptics
