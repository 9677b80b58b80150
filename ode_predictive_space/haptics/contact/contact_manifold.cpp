#include "ode_predictive_space/haptics/contact/contact_manifold.h"

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/contact/yielding_place.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rise_time = 0.5;     // s; until an object that appeared around the tool is rendered in full
constexpr double unnoticed = 1e-4;    // m; the depth at which a contact may begin,
constexpr double of_the_motion = 3.0; // or this multiple of the motion of tool and surface

double risen(double part, double dt)
{
    return std::min(1.0, part + dt / rise_time);
}
} // namespace

ContactManifold::ContactManifold()
{
    before_.reserve(touch_capacity);
    planes_.reserve(touch_capacity);
    matched_.reserve(touch_capacity);
}

void ContactManifold::follow(const ToolState &tool, TouchView view, double dt, std::optional<double> gap,
                             std::vector<Touch> &touches)
{
    matched_.assign(before_.size(), false);
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
    const Touch *known = known_before(touch);
    const Touch *carrier = known != nullptr && known->carry.carries() ? known : carrier_before(touch, view);
    touch.id = known != nullptr ? known->id : ++last_id_;
    touch.takes_over = carrier != nullptr ? carrier->id : 0;
    if (known == nullptr || touch.from_entry_side || view != TouchView::all_together ||
        !(known->normal.dot(touch.normal) < 0))
        return;
    // The tool came through, so the back is nearer now. The front surface has moved with the object.
    const Vector3 &front = known->normal;
    const double height = front.dot(tool_before_) + known->depth + front.dot(touch.surface_velocity) * dt;
    const double depth = height - front.dot(tool);
    if (depth > 0)
    {
        touch.normal = front;
        touch.depth = depth;
    }
}

/// Returns the object's touch in the tick before whose normal agrees best, among those that no other touch has matched. A touch
/// without a side of entry may have changed the side, and is the only one of its object.
const Touch *ContactManifold::known_before(const Touch &touch)
{
    std::size_t best = before_.size();
    double agreement = touch.from_entry_side ? same_surface : -2;
    for (std::size_t i = 0; i < before_.size(); ++i)
    {
        const double cosine = before_[i].normal.dot(touch.normal);
        if (before_[i].object == touch.object && !matched_[i] && cosine > agreement)
        {
            best = i;
            agreement = cosine;
        }
    }
    if (best == before_.size())
        return nullptr;
    matched_[best] = true;
    return &before_[best];
}

/// The touch of the tick before that carried the tool and whose normal agrees best. Objects that are felt alone take
/// over from each other only where their surfaces lie in one plane.
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

/// m; the rendered depth of the former touches along the touch's normal.
double ContactManifold::handed_over(const Touch &touch) const
{
    double most = 0;
    for (const Touch &known : before_)
        most = std::max(most, known.depth * known.normal.dot(touch.normal));
    return most;
}

/// m/s; the largest speed, relative to the tool, of the surfaces that held it in the tick before.
double ContactManifold::fastest_before(const ToolState &tool) const
{
    double fastest = 0;
    for (const Touch &known : before_)
        if (known.carry.carries())
            fastest = std::max(fastest, (known.surface_velocity - tool.linear_velocity).norm());
    return fastest;
}

/// The smallest part of the touches that carried the tool in the tick before; 0 without one.
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

/// The shares of an object that is felt alone scale with its depths; the joint solution changes when parts differ.
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

/// All touches of an object have the same part. A touch that takes over from others adds little lift, however deep it is. If
/// all touches together hold the tool where the former ones held it, except for their motion, the new touches have taken over.
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

/// Solves the constraint of each group of touches. If all objects hold the tool together, movable ones yield. The lag
/// that the tracker found is divided in proportion to the shares.
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
