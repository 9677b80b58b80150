#include "ode_predictive_space/haptics/contact/held_geoms.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

#include <algorithm>
#include <utility>

namespace ode_predictive_space::haptics
{
HeldGeoms::HeldGeoms()
{
    list_.reserve(touch_capacity + 1);
    before_.reserve(touch_capacity);
}

void HeldGeoms::renew()
{
    before_.clear();
    for (const HeldGeom &held : list_)
        before_.push_back(held.place);
    list_.clear();
    exceeds_ = false;
    adopts_ = false;
}

void HeldGeoms::forget()
{
    before_.clear();
    list_.clear();
}

void HeldGeoms::adopt(const ContactMemory &memory)
{
    adopts_ = true;
    if (memory.has_proxy)
        before_ = memory.places;
}

bool HeldGeoms::has(dGeomID geom) const
{
    return find_in(list_, [&](const HeldGeom &held) { return held.geom.id() == geom; }) != nullptr;
}

const ContactMemory::Place *HeldGeoms::place_before(dGeomID geom) const
{
    return find_in(before_, [&](const ContactMemory::Place &place) { return place.geom.id == geom; });
}

void HeldGeoms::add(NearbyGeom geom, const Vector3 &start, double most_drift, double distance)
{
    if (has(geom.id()))
        return;
    HeldGeom held;
    held.distance = distance;
    Vector3 place = start;
    held.place.geom = geom.identity();
    const auto was_near = [&](const ContactMemory::Place &last) { return last.geom == held.place.geom; };
    if (const ContactMemory::Place *last = find_in(before_, was_near))
    {
        const Vector3 carried = geom.to_scene(last->local);
        const double drift = (carried - last->at).norm();
        if (drift <= most_drift)
        {
            place = drift > 0 ? carried : last->at;
            held.place.drift = drift;
        }
    }
    held.geom = std::move(geom);
    held.put(place);
    const auto farther = [](double length, const HeldGeom &other) { return length < other.distance; };
    list_.insert(std::upper_bound(list_.begin(), list_.end(), distance, farther), std::move(held));
    if (list_.size() > touch_capacity)
    {
        list_.pop_back();
        exceeds_ = true;
    }
}
} // namespace ode_predictive_space::haptics
