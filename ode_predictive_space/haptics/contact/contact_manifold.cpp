#include "ode_predictive_space/haptics/contact/contact_manifold.h"

#include "ode_predictive_space/haptics/contact/closest_point.h"
#include "ode_predictive_space/haptics/contact/usual_touches.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
/// The cosine below which two planes are two surfaces, in the manifold and where planes are numbered. From facet to facet of one surface the normal turns by less than 60 degrees,
/// also around an edge that the tool crosses quickly; two walls of a channel, a floor and its wall differ by more.
constexpr double same_surface = 0.5;

/// m; how far the place of a touch may be off another one's plane and yet be a place of it. Bodies that rest beside each other differ
/// by less, and a step of that height cannot be felt.
constexpr double flush = 2e-5;

ConstraintPlane plane_of(const Touch &touch)
{
    ConstraintPlane plane;
    plane.normal = touch.normal;
    plane.depth = touch.depth;
    return plane;
}

/// Whether the second is a place in the plane of the first.
bool is_flush(const Vector3 &normal, const Vector3 &point, const Vector3 &other)
{
    return std::abs(normal.dot(other - point)) <= flush;
}
} // namespace

FeatureNumbers::FeatureNumbers()
{
    now_.reserve(usual_touches);
    before_.reserve(usual_touches);
}

void FeatureNumbers::begin()
{
    now_.swap(before_);
    now_.clear();
}

void FeatureNumbers::reset()
{
    now_.clear();
    before_.clear();
}

/// 0 is for those that have none yet.
void FeatureNumbers::number(std::vector<Touch> &touches, std::size_t first)
{
    while (recognise_one(touches, first))
    {}
    for (std::size_t i = first; i < touches.size(); ++i)
    {
        Touch &touch = touches[i];
        for (unsigned number = 1; touch.feature == 0; ++number)
            touch.feature = is_taken(touch.object, number) ? 0 : number;
        now_.push_back({touch.object, touch.feature, touch.normal});
    }
}

/// Of all touches without a number, and numbers without a touch, the two that agree best.
bool FeatureNumbers::recognise_one(std::vector<Touch> &touches, std::size_t first) const
{
    double best = same_surface;
    Touch *chosen = nullptr;
    unsigned number = 0;
    for (const Known &known : before_)
    {
        const auto has_it = [&](const Touch &touch) {
            return touch.object == known.object && touch.feature == known.number;
        };
        const auto begin = touches.begin() + static_cast<std::ptrdiff_t>(first);
        if (std::any_of(begin, touches.end(), has_it))
            continue;
        for (auto touch = begin; touch != touches.end(); ++touch)
        {
            const double agreement = touch->normal.dot(known.normal);
            if (touch->object == known.object && touch->feature == 0 && agreement > best)
            {
                best = agreement;
                chosen = &*touch;
                number = known.number;
            }
        }
    }
    if (chosen != nullptr)
        chosen->feature = number;
    return chosen != nullptr;
}

bool FeatureNumbers::is_taken(std::uintptr_t object, unsigned number) const
{
    const auto has_it = [&](const Known &known) { return known.object == object && known.number == number; };
    return std::any_of(before_.begin(), before_.end(), has_it) || std::any_of(now_.begin(), now_.end(), has_it);
}

ContactManifold::ContactManifold()
{
    before_.reserve(usual_touches);
    depths_.reserve(usual_touches);
    planes_.reserve(usual_touches);
}

void ContactManifold::recognise(const Vector3 &tool, TouchView view, double dt, std::vector<Touch> &touches)
{
    for (Touch &touch : touches)
    {
        const Known *known = itself(touch);
        const Known *carrier = known != nullptr && known->carries ? known : carrier_before(touch, view);
        touch.id = known != nullptr ? known->id : ++last_id_;
        touch.takes_over = carrier != nullptr ? carrier->id : 0;
        if (known == nullptr || touch.from_entry_side || view != TouchView::all_together ||
            !(known->normal.dot(touch.normal) < 0))
            continue;
        // The back of the object is nearer now: the tool came through it. The surface in front has moved with the object.
        const double height = known->height + known->normal.dot(touch.surface_velocity) * dt;
        const double depth = height - known->normal.dot(tool);
        if (depth > 0)
        {
            touch.normal = known->normal;
            touch.depth = depth;
        }
    }
    depths_.clear();
    for (const Touch &touch : touches)
        depths_.push_back(touch.depth);
}

const ContactManifold::Known *ContactManifold::itself(const Touch &touch) const
{
    const auto found = std::find_if(before_.begin(), before_.end(), [&](const Known &known) {
        return known.object == touch.object && known.feature == touch.feature;
    });
    return found != before_.end() ? &*found : nullptr;
}

/// Of those that carried the tool, the one whose normal is most like it. Objects that are felt as if there were no other take over
/// from each other only where one goes on in the plane of the other.
const ContactManifold::Known *ContactManifold::carrier_before(const Touch &touch, TouchView view) const
{
    const Known *best = nullptr;
    double agreement = same_surface;
    for (const Known &known : before_)
    {
        const double cosine = known.normal.dot(touch.normal);
        const bool reaches = view == TouchView::all_together || known.object == touch.object ||
                             is_flush(known.normal, known.point, touch.point);
        if (known.carries && reaches && cosine > agreement)
        {
            best = &known;
            agreement = cosine;
        }
    }
    return best;
}

const ContactManifold::Known *ContactManifold::object_before(const Touch &touch) const
{
    const auto found =
        std::find_if(before_.begin(), before_.end(), [&](const Known &known) { return known.object == touch.object; });
    return found != before_.end() ? &*found : nullptr;
}

const ContactManifold::Known *ContactManifold::taken_over_by(const Touch &touch) const
{
    const auto found = std::find_if(before_.begin(), before_.end(), [&](const Known &known) {
        return touch.takes_over != 0 && known.id == touch.takes_over;
    });
    return found != before_.end() ? &*found : nullptr;
}

/// m; how deep along the touch's normal the tool was in what it touched before.
double ContactManifold::handed_over(const Touch &touch) const
{
    double most = 0;
    for (const Known &known : before_)
        most = std::max(most, known.depth * known.normal.dot(touch.normal));
    return most;
}

void ContactManifold::let_rise(const ContactBirth &birth, bool watches, double dt, std::vector<Touch> &touches)
{
    bool all_of_it = true;
    for (Touch &touch : touches)
    {
        touch.part = part_of(touch, birth, watches, dt);
        all_of_it = all_of_it && touch.part == 1;
        touch.depth *= touch.part;
    }
    for (Touch &touch : touches)
        touch.is_solved = touch.is_solved && all_of_it; // else it was solved for other depths
}

/// An object rises as a whole: its touches have the same part.
double ContactManifold::part_of(const Touch &touch, const ContactBirth &birth, bool watches, double dt) const
{
    if (const Known *object = object_before(touch))
        return ContactBirth::risen(object->part, dt);
    if (watches && !birth.began_at_surface(touch, handed_over(touch)))
        return 0;
    const Known *carrier = taken_over_by(touch);
    return carrier != nullptr ? ContactBirth::risen(carrier->part, dt) : 1;
}

void ContactManifold::solve(const Vector3 &tool, TouchView view, std::vector<Touch> &touches)
{
    const auto is_solved = [](const Touch &touch) { return touch.is_solved; };
    if (!std::all_of(touches.begin(), touches.end(), is_solved))
    {
        if (view == TouchView::all_together)
        {
            solve_together(touches);
        }
        else
        {
            for (std::size_t i = 0; i < touches.size(); ++i)
                if (!is_solved(touches[i]))
                    solve_alone(touches, i);
        }
    }
    if (view == TouchView::each_object_alone)
        count_flush_touches_once(touches);
    remember(tool, touches);
}

/// All planes at once. What the tracker's part lags behind stays, in proportion.
void ContactManifold::solve_together(std::vector<Touch> &touches)
{
    planes_.clear();
    Vector3 lag = Vector3::Zero();
    for (const Touch &touch : touches)
    {
        planes_.push_back(plane_of(touch));
        lag += touch.is_solved ? touch.carry.lag : Vector3(Vector3::Zero());
    }
    find_closest_point(planes_);
    double carried = 0;
    for (const ConstraintPlane &plane : planes_)
        carried += plane.share;
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const double share = planes_[i].share;
        touches[i].carry = {share, carried > 0 ? Vector3(share / carried * lag) : Vector3(Vector3::Zero())};
        touches[i].is_solved = true;
    }
}

/// The planes of one object share the shortest way out of it.
///
/// @param first of the object's touches.
void ContactManifold::solve_alone(std::vector<Touch> &touches, std::size_t first)
{
    const auto same_object = [&](const Touch &touch) { return touch.object == touches[first].object; };
    planes_.clear();
    for (std::size_t i = first; i < touches.size(); ++i)
        if (same_object(touches[i]))
            planes_.push_back(plane_of(touches[i]));
    if (planes_.size() > 1)
        find_closest_point(planes_);
    else
        planes_[0].share = planes_[0].depth;
    std::size_t plane = 0;
    for (std::size_t i = first; i < touches.size(); ++i)
    {
        if (same_object(touches[i]))
        {
            touches[i].carry = {planes_[plane++].share, Vector3::Zero()};
            touches[i].is_solved = true;
        }
    }
}

void ContactManifold::remember(const Vector3 &tool, const std::vector<Touch> &touches)
{
    before_.clear();
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const Touch &touch = touches[i];
        before_.push_back({touch.object, touch.feature, touch.id, touch.carry.carries(), touch.normal, touch.point,
                           touch.normal.dot(tool) + touch.depth, depths_[i], touch.part});
    }
}

void count_flush_touches_once(std::vector<Touch> &touches)
{
    const auto counts = [](const Touch &touch) { return touch.from_entry_side && touch.carry.carries(); };
    for (Touch &touch : touches)
    {
        if (!counts(touch))
            continue;
        for (const Touch &other : touches)
        {
            const bool deeper = other.depth > touch.depth || (other.depth == touch.depth && &other < &touch);
            if (other.object != touch.object && deeper && counts(other) &&
                is_flush(other.normal, other.point, touch.point))
            {
                touch.carry = Carry{};
                break;
            }
        }
    }
}
} // namespace ode_predictive_space::haptics
