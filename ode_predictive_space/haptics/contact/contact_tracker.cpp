#include "ode_predictive_space/haptics/contact/contact_tracker.h"

#include "ode_predictive_space/haptics/contact/excluded_geoms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::size_t usual_geoms = NearbyGeoms::capacity;
constexpr double ahead = 1.5;     // times the tool's way: how far ahead surfaces are looked for
constexpr double catching_up = 2; // times the tool's way: how far the proxy may go in a tick
constexpr double gentle = 0.09; // N; by how much the force may change in a tick beyond what the tool's way makes of it
constexpr double around = 1.5;  // times the proxy's way: the ball that holds all that it may reach, and more
constexpr double steps_ahead = 2;    // times the tool's way: how far it may go until geoms come from another thread
constexpr double farthest_apart = 4; // times the radius; geoms that squeeze the sphere more have passed each other
constexpr double in_contact = 1e-6;  // of the radius
} // namespace

bool is_finite(const Touch &touch)
{
    return touch.point.allFinite() && touch.normal.allFinite() && std::isfinite(touch.depth) &&
           touch.surface_velocity.allFinite() && std::isfinite(touch.carry.share) && touch.carry.lag.allFinite();
}

ContactTracker::ContactTracker(double radius) : radius_(radius)
{
    near_.reserve(usual_geoms);
    before_.reserve(usual_geoms);
    places_.reserve(usual_geoms);
    carriers_.reserve(usual_geoms);
    told_.reserve(usual_geoms);
}

void ContactTracker::begin()
{
    before_.clear();
    for (const Held &held : near_)
        before_.push_back(held.place);
    near_.clear();
    features_.begin();
    pace_.adopts = false;
}

void ContactTracker::forget()
{
    has_proxy_ = false;
    before_.clear();
    near_.clear();
    features_.reset();
    carriers_.clear();
    pace_.released = false;
}

void ContactTracker::adopt(const ContactMemory &memory)
{
    pace_.adopts = true;
    if (memory.has_proxy)
    {
        proxy_ = memory.proxy;
        before_.assign(memory.places.begin(), memory.places.begin() + static_cast<std::ptrdiff_t>(memory.count));
    }
}

void ContactTracker::remember_in(ContactMemory &memory) const
{
    memory.has_proxy = has_proxy_;
    memory.proxy = proxy_;
    memory.count = std::min(near_.size(), memory.places.size());
    std::transform(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(memory.count), memory.places.begin(),
                   [](const Held &held) { return held.place; });
}

void ContactTracker::aim(const Vector3 &tool)
{
    pace_.travel = has_proxy_ ? Vector3(tool - tool_) : Vector3::Zero();
    pace_.moved = pace_.travel.norm();
    pace_.ahead = pace_.adopts ? steps_ahead * pace_.moved : 0;
    tool_ = tool;
    if (!has_proxy_)
    {
        proxy_ = tool;
        has_proxy_ = true;
    }
    start_ = proxy_;
    pace_.longest = std::max(radius_, catching_up * pace_.moved);
    pace_.gently = !carriers_.empty() && !pace_.released && !pace_.adopts;
}

/// m; how far the proxy may go in a tick, beyond what the tool's way makes of it.
double ContactTracker::catch_up() const
{
    double stiffest = pace_.stiffness;
    for (const Held &held : near_)
        stiffest = held.geom.material() ? std::max(stiffest, held.geom.material()->stiffness) : stiffest;
    return stiffest > 0 ? gentle / stiffest : radius_;
}

// All that the proxy may reach lies between two balls: one about where it is, and one about the tool that goes through
// there.
ContactTracker::Region ContactTracker::region() const
{
    const Vector3 way = tool_ - start_;
    const double length = way.norm();
    const double step = std::min(length, pace_.longest);
    Region region;
    region.centre = step < length ? Vector3(start_ + way * (step / length)) : tool_;
    double drift = 0;
    double farthest = 0; // of the places that differ from the proxy
    for (const ContactMemory::Place &place : before_)
    {
        drift = std::max(drift, place.drift);
        if ((place.at - start_).norm() > in_contact * radius_)
            farthest = std::max(farthest, (place.at - region.centre).norm());
    }
    region.radius = radius_ + margin_ + pace_.ahead + std::max(around * step, farthest) + 2 * drift;
    return region;
}

TriangleList ContactTracker::touched_triangles(dGeomID geom) const
{
    const auto found = std::find_if(before_.begin(), before_.end(),
                                    [&](const ContactMemory::Place &place) { return place.geom.id == geom; });
    return found != before_.end() ? found->triangles : TriangleList();
}

const ContactMemory::Place *ContactTracker::known(const NearbyGeom &geom) const
{
    const auto found = std::find_if(before_.begin(), before_.end(),
                                    [&](const ContactMemory::Place &place) { return place.geom == geom.identity(); });
    return found != before_.end() ? &*found : nullptr;
}

void ContactTracker::add_if_near(NearbyGeom geom)
{
    const Region around = region();
    const double distance = geom.distance(around.centre, around.radius);
    if (distance < around.radius)
        insert(std::move(geom), distance);
}

void ContactTracker::insert(NearbyGeom geom, double distance)
{
    const auto same = [&](const Held &held) { return held.geom.id() == geom.id(); };
    if (std::any_of(near_.begin(), near_.end(), same))
        return;
    Held held;
    held.distance = distance;
    held.start = start_;
    held.place.geom = geom.identity();
    if (const ContactMemory::Place *last = known(geom))
    {
        const Vector3 carried = geom.to_scene(last->local);
        const double drift = (carried - last->at).norm();
        if (drift <= farthest_carried * radius_)
        {
            held.start = drift > 0 ? carried : last->at;
            held.place.drift = drift;
        }
    }
    held.geom = std::move(geom);
    const auto farther = [](double length, const Held &other) { return length < other.distance; };
    near_.insert(std::upper_bound(near_.begin(), near_.end(), distance, farther), std::move(held));
}

void ContactTracker::hand_over(NearbyGeoms &geoms, double time) const
{
    std::vector<std::pair<double, const NearbyGeom *>> nearest;
    const double most = region().radius;
    for (const Held &held : near_)
    {
        const bool all_go = near_.size() <= geoms.geoms.size();
        nearest.emplace_back(all_go ? 0 : held.geom.distance(held.start, most), &held.geom);
    }
    geoms.count = std::min(near_.size(), geoms.geoms.size());
    const auto end = nearest.begin() + static_cast<std::ptrdiff_t>(geoms.count);
    std::nth_element(nearest.begin(), end, nearest.end());
    std::transform(nearest.begin(), end, geoms.geoms.begin(), [](const auto &near) { return *near.second; });
    std::fill(geoms.geoms.begin() + static_cast<std::ptrdiff_t>(geoms.count), geoms.geoms.end(), NearbyGeom());
    geoms.time = time;
}

SphereSlide::Task ContactTracker::task() const
{
    SphereSlide::Task task;
    task.radius = radius_;
    task.goal = tool_;
    task.start = start_;
    task.look = ahead * pace_.moved;
    task.longest = pace_.longest;
    task.margin = margin_;
    if (pace_.gently)
    {
        double drift = 0;
        for (const Held &held : near_)
            drift = std::max(drift, held.place.drift);
        task.reach_centre = start_ + pace_.travel;
        task.reach = pace_.moved + drift + pace_.catch_up;
    }
    return task;
}

/// A touch that held the proxy at the last tick and is not reported at this one has released it.
void ContactTracker::choose_pace()
{
    const bool all_there = std::all_of(carriers_.begin(), carriers_.end(), [&](const Carrier &carrier) {
        return std::any_of(near_.begin(), near_.end(),
                           [&](const Held &held) { return held.geom.id() == carrier.geom; });
    });
    pace_.released = pace_.released || !all_there;
}

void ContactTracker::follow()
{
    places_.clear();
    for (const Held &held : near_)
        places_.push_back({&held.geom, held.start, 0});
    choose_pace();
    common_ = slide_.run(task(), places_);
    pace_.catch_up = catch_up();
    settle(common_);
}

void ContactTracker::settle(bool common)
{
    if (near_.empty())
    {
        const double way = (tool_ - start_).norm();
        proxy_ = way > pace_.longest ? Vector3(start_ + (tool_ - start_) * (pace_.longest / way)) : tool_;
        return;
    }
    for (std::size_t i = 0; i < near_.size(); ++i)
    {
        ContactMemory::Place &place = near_[i].place;
        place.at = places_[i].at;
        place.local = near_[i].geom.to_local(places_[i].at);
        place.triangles = {};
    }
    for (const SlidePlane &plane : slide_.planes())
        if (plane.share > 0 && plane.feature.triangle >= 0)
            near_[plane.place].place.triangles.add(plane.feature.triangle);
    // While geoms squeeze the sphere, the place that is farthest from the tool is the one that is behind nothing.
    const auto farthest = std::max_element(near_.begin(), near_.end(), [&](const Held &a, const Held &b) {
        return (a.place.at - tool_).squaredNorm() < (b.place.at - tool_).squaredNorm();
    });
    proxy_ = common ? near_.front().place.at : farthest->place.at;
    if (!common)
        bring_together();
}

/// A place that is too far from the proxy to be that of the same sphere is given up: the region() holds all places.
void ContactTracker::bring_together()
{
    for (Held &held : near_)
    {
        if ((held.place.at - proxy_).norm() > farthest_apart * radius_)
        {
            held.place.at = proxy_;
            held.place.local = held.geom.to_local(proxy_);
            held.place.drift = 0;
        }
    }
}

bool ContactTracker::touches(TouchView view, std::vector<Touch> &touches)
{
    const std::size_t first = touches.size();
    const bool several = std::any_of(near_.begin(), near_.end(), [&](const Held &held) {
        return held.geom.object() != near_.front().geom.object();
    });
    told_.clear();
    if (near_.empty())
        pace_.released = pace_.released && proxy_ != tool_;
    else if (view == TouchView::all_together || !several || proxy_ == tool_)
        tell_together(touches);
    else
        tell_each_object(touches);
    features_.number(touches, first);
    note_carriers(touches, first);
    const auto first_nonsense = std::remove_if(touches.begin() + static_cast<std::ptrdiff_t>(first), touches.end(),
                                               [](const Touch &touch) { return !is_finite(touch); });
    const bool all = first_nonsense == touches.end();
    touches.erase(first_nonsense, touches.end());
    return all;
}

/// m; from where the planes of the last slide let the sphere go, to the place to which it came.
Vector3 ContactTracker::lag_at(const Vector3 &place) const
{
    Vector3 lag = place - tool_;
    for (const SlidePlane &plane : slide_.planes())
        lag -= plane.share * plane.feature.normal;
    return lag.norm() <= in_contact * radius_ ? Vector3(Vector3::Zero()) : lag;
}

void ContactTracker::tell_together(std::vector<Touch> &touches)
{
    Vector3 lag = common_ ? lag_at(proxy_) : Vector3(Vector3::Zero());
    pace_.released = pace_.released && !lag.isZero(0);
    if (pace_.released)
        lag.setZero();
    if (tell_planes(lag, touches) == 0 && !lag.isZero(0))
        carry_on(lag, touches);
}

/// What the last slide found. @return m; what the planes carry together.
double ContactTracker::tell_planes(const Vector3 &lag, std::vector<Touch> &touches)
{
    double carried = 0;
    for (const SlidePlane &plane : slide_.planes())
        carried += plane.share;
    for (const SlidePlane &plane : slide_.planes())
    {
        const bool touched =
            plane.share > 0 || (plane.depth > 0 && plane.feature.distance <= radius_ * (1 + in_contact));
        const bool near = plane.depth > -margin_ && plane.feature.distance <= radius_ + margin_;
        if (!touched && !(near && margin_ > 0))
            continue;
        const NearbyGeom &geom = *places_[plane.place].geom;
        Touch touch;
        touch.point = plane.feature.point;
        touch.normal = plane.feature.normal;
        touch.depth = touched ? std::max(0.0, plane.depth) : plane.depth;
        touch.surface_velocity = geom.velocity_at(touch.point);
        touch.object = geom.object();
        touch.from_entry_side = true;
        touch.carry = {plane.share, carried > 0 ? Vector3(plane.share / carried * lag) : Vector3(Vector3::Zero())};
        touch.is_solved = true;
        touch.material = geom.material();
        touches.push_back(touch);
        told_.push_back(geom.id());
    }
    return carried;
}

/// The proxy has left all surfaces, and is on its way to the tool: what it left lets go of it no faster than it comes there.
void ContactTracker::carry_on(const Vector3 &lag, std::vector<Touch> &touches)
{
    double sum = 0;
    for (const Carrier &carrier : carriers_)
        sum += (carrier.touch.carry.share * carrier.touch.normal + carrier.touch.carry.lag).norm();
    for (const Carrier &carrier : carriers_)
    {
        Touch touch = carrier.touch;
        const double part = (touch.carry.share * touch.normal + touch.carry.lag).norm() / sum;
        touch.carry = {0, part * lag};
        touch.depth = std::max(0.0, part * lag.dot(touch.normal));
        touches.push_back(touch);
        told_.push_back(carrier.geom);
    }
}

void ContactTracker::note_carriers(const std::vector<Touch> &touches, std::size_t first)
{
    carriers_.clear();
    for (std::size_t i = first; i < touches.size(); ++i)
        if (touches[i].carry.carries())
            carriers_.push_back({told_[i - first], touches[i]});
}

/// Each object holds off the tool as if there were no other; on which side of it the tool is, all of them have said.
void ContactTracker::tell_each_object(std::vector<Touch> &touches)
{
    for (std::size_t i = 0; i < near_.size(); ++i)
    {
        const std::uintptr_t object = near_[i].geom.object();
        const auto earlier = std::find_if(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(i),
                                          [&](const Held &held) { return held.geom.object() == object; });
        if (earlier != near_.begin() + static_cast<std::ptrdiff_t>(i))
            continue;
        places_.clear();
        for (const Held &held : near_)
            if (held.geom.object() == object)
                places_.push_back({&held.geom, held.place.at, 0});
        SphereSlide::Task alone = task();
        alone.longest = std::max(alone.longest, 2 * (proxy_ - tool_).norm());
        alone.reach = std::numeric_limits<double>::infinity();
        const bool common = slide_.run(alone, places_);
        tell_planes(common ? lag_at(places_.front().at) : Vector3(Vector3::Zero()), touches);
    }
}
} // namespace ode_predictive_space::haptics
