#include "ode_predictive_space/haptics/contact/contact_manifold.h"

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/contact/yielding_place.h"

#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rise_time = 0.5;     // s; of an object that appeared around the tool
constexpr double unnoticed = 1e-4;    // m; so deep a contact may begin,
constexpr double of_the_motion = 3.0; // or by so many times the motion of tool and surface

/// The part of a depth that is felt after a time dt: 0 to 1.
double risen(double part, double dt)
{
    return std::min(1.0, part + dt / rise_time);
}
} // namespace

ContactManifold::ContactManifold()
{
    before_.reserve(touch_capacity);
    planes_.reserve(touch_capacity);
}

void ContactManifold::follow(const ToolState &tool, TouchView view, double dt, std::optional<double> gap,
                             std::vector<Touch> &touches)
{
    for (Touch &touch : touches)
        recognise(tool.position, view, dt, touch);
    note_lift(touches);
    let_rise(tool, view, dt, gap, touches);
    solve(view, dt, touches);
    for (Touch &touch : touches)
    {
        const Touch *last = taken_over_by(touch);
        if (last != nullptr && last->material && touch.material && touch.carry.carries())
            touch.material = blended(*last->material, *touch.material, dt);
    }
    before_ = touches;
    tool_before_ = tool.position;
    released_ = false;
}

void ContactManifold::recognise(const Vector3 &tool, TouchView view, double dt, Touch &touch)
{
    const Touch *known = find_in(
        before_, [&](const Touch &before) { return before.object == touch.object && before.feature == touch.feature; });
    const Touch *carrier = known != nullptr && known->carry.carries() ? known : carrier_before(touch, view);
    touch.id = known != nullptr ? known->id : ++last_id_;
    touch.takes_over = carrier != nullptr ? carrier->id : 0;
    if (known == nullptr || touch.from_entry_side || view != TouchView::all_together ||
        !(known->normal.dot(touch.normal) < 0))
        return;
    // The back of the object is nearer now: the tool came through it. The surface in front has moved with the object.
    const Vector3 &front = known->normal;
    const double height = front.dot(tool_before_) + known->depth + front.dot(touch.surface_velocity) * dt;
    const double depth = height - front.dot(tool);
    if (depth > 0)
    {
        touch.normal = front;
        touch.depth = depth;
    }
}

/// Of those that carried the tool, the one whose normal is most like it. Objects that are felt as if there were no other take over
/// from each other only where one goes on in the plane of the other.
const Touch *ContactManifold::carrier_before(const Touch &touch, TouchView view) const
{
    const Touch *best = nullptr;
    double agreement = same_surface;
    for (const Touch &known : before_)
    {
        const double cosine = known.normal.dot(touch.normal);
        const bool reaches = view == TouchView::all_together || known.object == touch.object ||
                             is_flush(known.normal, known.point, touch.point);
        if (known.carry.carries() && reaches && cosine > agreement)
        {
            best = &known;
            agreement = cosine;
        }
    }
    return best;
}

const Touch *ContactManifold::taken_over_by(const Touch &touch) const
{
    return find_in(before_, [&](const Touch &known) { return known.id == touch.takes_over; });
}

/// m; how deep along the touch's normal the tool was, as far as it was felt, in what it touched before.
double ContactManifold::handed_over(const Touch &touch) const
{
    double most = 0;
    for (const Touch &known : before_)
        most = std::max(most, known.depth * known.normal.dot(touch.normal));
    return most;
}

/// m/s; of what held the tool in the tick before, beside the tool.
double ContactManifold::fastest_before(const ToolState &tool) const
{
    double fastest = 0;
    for (const Touch &known : before_)
        if (known.carry.carries())
            fastest = std::max(fastest, (known.surface_velocity - tool.linear_velocity).norm());
    return fastest;
}

/// The smallest part of a touch that carried the tool in the tick before; 0 when there was none.
double ContactManifold::least_part_before() const
{
    double least = 1;
    bool carried = false;
    for (const Touch &known : before_)
    {
        carried = carried || known.carry.carries();
        least = known.carry.carries() ? std::min(least, known.part) : least;
    }
    return carried ? least : 0;
}

/// Where each object is felt alone, its shares rise as its depths do. Together, objects with different parts have other shares.
void ContactManifold::let_rise(const ToolState &tool, TouchView view, double dt, std::optional<double> gap,
                               std::vector<Touch> &touches)
{
    bool all_of_it = true;
    for (Touch &touch : touches)
    {
        touch.part = part_of(touch, tool, dt, gap);
        all_of_it = all_of_it && touch.part == 1;
        touch.depth *= touch.part;
        touch.carry = {touch.part * touch.carry.share, touch.part * touch.carry.lag};
    }
    for (Touch &touch : touches)
        touch.is_solved = touch.is_solved && (all_of_it || view == TouchView::each_object_alone);
}

void ContactManifold::note_lift(const std::vector<Touch> &touches)
{
    const Vector3 before = lift_;
    lift_.setZero();
    for (const Touch &touch : touches)
        lift_ += carry_of(touch).share * touch.normal + carry_of(touch).lag;
    jump_ = (lift_ - before).norm();
}

/// An object rises as a whole: its touches have the same part. What a touch takes over from others lifts the proxy by little, however
/// deep it is. If all touches together hold the tool where the former ones held it, but for their motion, new touches have taken over from the
/// former.
double ContactManifold::part_of(const Touch &touch, const ToolState &tool, double dt, std::optional<double> gap) const
{
    if (released_)
        return 0;
    if (const Touch *known = find_in(before_, [&](const Touch &other) { return other.object == touch.object; }))
        return risen(known->part, dt);
    const double speed = (touch.surface_velocity - tool.linear_velocity).norm();
    const auto usual = [&](double fastest) { return unnoticed + of_the_motion * gap.value_or(0) * fastest; };
    const double lifts = std::min(touch.depth, carry_of(touch).share);
    if (gap && !(lifts <= usual(speed) + handed_over(touch)))
        return jump_ <= usual(std::max(speed, fastest_before(tool))) ? risen(least_part_before(), dt) : 0;
    const Touch *carrier = taken_over_by(touch);
    return carrier != nullptr ? risen(carrier->part, dt) : 1;
}

/// Divides the shortest way out of all planes of a group among these planes. If all objects hold the tool together, movable ones give way.
/// The lag that the tracker found is divided in proportion to the shares.
void ContactManifold::solve(TouchView view, double dt, std::vector<Touch> &touches)
{
    while (const Touch *first = find_in(touches, [](const Touch &touch) { return !touch.is_solved; }))
    {
        const auto in_group = [&, object = first->object](const Touch &touch) {
            return view == TouchView::all_together || touch.object == object;
        };
        planes_.clear();
        Vector3 lag = Vector3::Zero();
        bool yields = false;
        for (const Touch &touch : touches)
        {
            if (!in_group(touch))
                continue;
            const double stiffness = touch.material ? touch.material->stiffness : 0;
            const double seconds = std::max(dt, touch.response_time);
            planes_.push_back({touch.normal, touch.depth, yield_of(stiffness, touch.mobility, seconds)});
            const bool may_yield = view == TouchView::all_together || touch.response_time > dt;
            yields = yields || (may_yield && planes_.back().yield > rigid_yield);
            lag += carry_of(touch).lag;
        }
        if (yields)
            find_yielding_place(planes_);
        else
            find_closest_point(planes_);
        double carried = 0;
        for (const ConstraintPlane &plane : planes_)
            carried += plane.share;
        std::size_t plane = 0;
        for (Touch &touch : touches)
        {
            if (!in_group(touch))
                continue;
            const double share = planes_[plane++].share;
            touch.carry = {share, carried > 0 ? Vector3(share / carried * lag) : Vector3(Vector3::Zero())};
            touch.is_solved = true;
        }
    }
}
} // namespace ode_predictive_space::haptics
