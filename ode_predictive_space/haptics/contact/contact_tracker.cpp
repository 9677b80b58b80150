#include "ode_predictive_space/haptics/contact/contact_tracker.h"

#include "ode_predictive_space/haptics/contact/contact_manifold.h"
#include "ode_predictive_space/haptics/contact/excluded_geoms.h"
#include "ode_predictive_space/haptics/contact/short_list.h"

#include <cmath>
#include <limits>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double ahead = 1.5;     // of the tool's travel; distance of the search for surfaces
constexpr double catching_up = 2; // of the tool's travel; maximum travel of the proxy in a tick
constexpr double gentle = 0.09;   // N; maximum change of the force in a tick beyond the tool's travel
constexpr double around = 1.5;    // of the proxy's travel; radius of the ball that holds all places that it may reach
constexpr double steps_ahead = 2; // of the tool's travel; until another thread delivers geoms
constexpr double farthest_apart = 4; // radii; geoms that squeeze the sphere more have passed each other
constexpr double in_contact = 1e-6;  // of the radius
} // namespace

bool is_finite(const Touch &touch)
{
    return touch.point.allFinite() && touch.arm.allFinite() && touch.normal.allFinite() && std::isfinite(touch.depth) &&
           std::isfinite(touch.mobility) && touch.surface_velocity.allFinite() && std::isfinite(touch.carry.share) &&
           touch.carry.lag.allFinite();
}

bool keep_within_capacity(std::vector<Touch> &touches)
{
    if (touches.size() <= touch_capacity)
        return false;
    const auto counts_more = [](const Touch &a, const Touch &b) {
        const bool carries = carry_of(a).carries();
        return carries != carry_of(b).carries() ? carries : a.depth > b.depth;
    };
    std::nth_element(touches.begin(), touches.begin() + touch_capacity, touches.end(), counts_more);
    touches.resize(touch_capacity);
    return true;
}

ContactTracker::ContactTracker(double radius) : radius_(radius)
{
    yielding_.reserve(SphereSlide::usual_planes);
    places_.reserve(touch_capacity);
}

void ContactTracker::begin()
{
    near_.renew();
    reported_.begin();
}

void ContactTracker::forget()
{
    course_.has_proxy = false;
    near_.forget();
    reported_.forget();
    released_ = false;
    carries_on_ = false;
}

void ContactTracker::adopt(const ContactMemory &memory)
{
    near_.adopt(memory);
    if (memory.has_proxy)
        course_.proxy = memory.proxy;
}

void ContactTracker::remember_in(ContactMemory &memory) const
{
    memory.has_proxy = course_.has_proxy;
    memory.proxy = course_.proxy;
    memory.places.clear();
    for (const HeldGeom &held : near_.list())
        memory.places.push_back(held.place);
}

void ContactTracker::Course::aim(const Vector3 &to)
{
    travel = has_proxy ? Vector3(to - tool) : Vector3::Zero();
    tool = to;
    if (!has_proxy)
        proxy = to;
    has_proxy = true;
    start = proxy;
}

double ContactTracker::longest_travel() const
{
    return std::max(radius_, catching_up * course_.travel.norm());
}

// The proxy stays between two balls: one about its place, and one about the tool whose surface contains this place.
ContactTracker::Region ContactTracker::region() const
{
    const Vector3 way = course_.tool - course_.start;
    const double length = way.norm();
    const double step = std::min(length, longest_travel());
    Region region;
    region.centre = step < length ? Vector3(course_.start + way * (step / length)) : course_.tool;
    double drift = 0;
    double farthest = 0;
    for (const ContactMemory::Place &place : near_.places_before())
    {
        drift = std::max(drift, place.drift);
        if ((place.at - course_.start).norm() > in_contact * radius_)
            farthest = std::max(farthest, (place.at - region.centre).norm());
    }
    const double until_looked_for_again = near_.adopts() ? steps_ahead * course_.travel.norm() : 0;
    region.radius = radius_ + margin_ + until_looked_for_again + std::max(around * step, farthest) + 2 * drift;
    return region;
}

Vector3 ContactTracker::start_beside(dGeomID geom) const
{
    const auto *place = near_.place_before(geom);
    if (place == nullptr)
        return course_.start;
    const Vector3 carried = place->local + pose_of(geom).position;
    return (carried - place->at).norm() <= farthest_carried * radius_ ? carried : course_.start;
}

TriangleList ContactTracker::touched_triangles(dGeomID geom) const
{
    const auto *place = near_.place_before(geom);
    return place != nullptr ? place->triangles : TriangleList();
}

void ContactTracker::add_if_near(NearbyGeom geom)
{
    const Region around = region();
    const double distance = geom.distance(around.centre, around.radius);
    if (distance < around.radius)
        add(std::move(geom), distance);
}

void ContactTracker::add(NearbyGeom geom, double distance)
{
    near_.add(std::move(geom), course_.start, farthest_carried * radius_, distance);
}

/// m; maximum displacement of the proxy in this tick that explains a change of the force.
double ContactTracker::travel_of_force() const
{
    double drift = 0;
    for (const HeldGeom &held : near_.list())
        drift = std::max({drift, held.place.drift, tick_length_ * held.geom.speed_of_plane()});
    return course_.travel.norm() + drift + catch_up_;
}

/// m; as above, where bodies yield: one that bounces off a spring changes the force by more than stiffness times its travel.
double ContactTracker::travel_of_bodies() const
{
    double farthest = 0;
    const auto note = [&](const Vector3 &velocity, double mobility, double step) {
        const double seconds = std::max(tick_length_, step);
        const double swing = mobility > 0 ? 1 / (std::sqrt(2 * stiffness_ * mobility) * seconds) : 0;
        farthest = std::max(farthest, std::max(1.0, swing) * tick_length_ * velocity.norm());
    };
    for (const SlidePlane &plane : slide_.planes())
    {
        const NearbyGeom &geom = *places_[plane.place].geom;
        note(geom.velocity_at(plane.feature.point), geom.mobility_at(plane.feature.point, plane.feature.normal),
             geom.step());
    }
    for (const TouchOfGeom &reported : reported_.before)
        note(reported.touch.surface_velocity, reported.touch.mobility, reported.touch.response_time);
    return course_.travel.norm() + farthest + catch_up_;
}

SphereSlide::Task ContactTracker::task() const
{
    SphereSlide::Task task;
    task.radius = radius_;
    task.goal = course_.tool;
    task.start = course_.start;
    task.look = ahead * course_.travel.norm();
    task.longest = longest_travel();
    task.margin = margin_;
    const auto carries = [](const TouchOfGeom &reported) { return reported.touch.carry.carries(); };
    if (find_in(reported_.before, carries) != nullptr && !held_by_body() && !released_ &&
        !near_.adopts()) // the rendered force follows the proxy, and must not jump
    {
        task.reach_centre = course_.start + course_.travel;
        task.reach = travel_of_force();
    }
    return task;
}

bool ContactTracker::held_by_body() const
{
    const auto holds = [](const TouchOfGeom &reported) {
        return reported.touch.carry.carries() && reported.touch.mobility > 0;
    };
    return find_in(reported_.before, holds) != nullptr;
}

/// Whether a missing geom has ended: its touched point is inside the region, so the near callback should have reported
/// it. A surface that the proxy has left may be outside.
bool ContactTracker::is_gone(const TouchOfGeom &reported) const
{
    const Region searched = region();
    return reported.touch.carry.carries() && !carries_on_ && !near_.has(reported.geom) &&
           (reported.touch.point - searched.centre).norm() < searched.radius;
}

void ContactTracker::follow()
{
    places_.clear();
    for (const HeldGeom &held : near_.list())
        places_.push_back({&held.geom, held.place.at, 0});
    common_ = slide_.run(task(), places_);
    visited_ = SphereSlide::most_triangles - slide_.left();
    const auto has_gone = [this](const TouchOfGeom &reported) { return is_gone(reported); };
    released_ = released_ || find_in(reported_.before, has_gone) != nullptr;
    double stiffest = stiffness_;
    for (const HeldGeom &held : near_.list())
        stiffest = held.geom.material() ? std::max(stiffest, held.geom.material()->stiffness) : stiffest;
    catch_up_ = stiffest > 0 ? gentle / stiffest : radius_;
    settle();
}

/// While geoms squeeze the sphere, the place farthest from the tool is behind no surface. A place too far from it is
/// dropped, because the region() contains all places.
void ContactTracker::settle()
{
    if (near_.list().empty())
    {
        course_.proxy = SphereSlide::unhindered(task());
        return;
    }
    course_.proxy = places_.front().at;
    for (std::size_t i = 0; i < near_.list().size(); ++i)
    {
        near_.list()[i].put(places_[i].at);
        if (!common_ && (places_[i].at - course_.tool).squaredNorm() > (course_.proxy - course_.tool).squaredNorm())
            course_.proxy = places_[i].at;
    }
    for (const SlidePlane &plane : slide_.planes())
        if (plane.share > 0 && plane.feature.triangle >= 0)
            near_.list()[plane.place].place.triangles.add(plane.feature.triangle);
    for (HeldGeom &held : near_.list())
    {
        if (!common_ && (held.place.at - course_.proxy).norm() > farthest_apart * radius_)
        {
            held.put(course_.proxy);
            held.place.drift = 0;
        }
    }
}

bool ContactTracker::touches(TouchView view, std::vector<Touch> &touches)
{
    const auto is_other = [&](const HeldGeom &held) {
        return held.geom.object() != near_.list().front().geom.object();
    };
    reported_.now.clear();
    carries_on_ = false;
    if (near_.list().empty() || view == TouchView::all_together || find_in(near_.list(), is_other) == nullptr ||
        course_.proxy == course_.tool)
        report_together(view);
    else
        report_each_object();
    const std::size_t most = touches.size() + reported_.now.size();
    for (const TouchOfGeom &reported : reported_.now)
        if (is_finite(reported.touch))
            touches.push_back(reported.touch);
    return touches.size() == most;
}

/// m; from the place that the planes of the last slide allow to the place that the sphere reached.
Vector3 ContactTracker::lag_at(const Vector3 &place) const
{
    Vector3 lag = place - course_.tool;
    for (const SlidePlane &plane : slide_.planes())
        lag -= plane.share * plane.feature.normal;
    return lag.norm() <= in_contact * radius_ ? Vector3(Vector3::Zero()) : lag;
}

/// Movable bodies come and go faster than a bounded proxy could follow: a proxy that lags would see each body from
/// another place, and push it aside. So the proxy is not bounded there. The lift of the tick before is, so that it
/// changes no faster than tool and bodies explain.
Vector3 ContactTracker::remaining_lift() const
{
    Vector3 before = -course_.travel;
    for (const TouchOfGeom &reported : reported_.before)
        before += reported.touch.carry.share * reported.touch.normal + reported.touch.carry.lag;
    const Vector3 fading = before - lift_of(yielding_);
    const double length = fading.norm(), way = travel_of_bodies();
    return length > way ? Vector3((1 - way / length) * fading) : Vector3(Vector3::Zero());
}

/// The proxy has left all surfaces, and the force of the touches that carried it fades while it moves to the tool.
void ContactTracker::report_former_carriers(const Vector3 &lag)
{
    const auto lift_of_touch = [](const TouchOfGeom &carrier) {
        return (carrier.touch.carry.share * carrier.touch.normal + carrier.touch.carry.lag).norm();
    };
    double sum = 0;
    for (const TouchOfGeom &carrier : reported_.before)
        sum += lift_of_touch(carrier);
    for (TouchOfGeom carrier : reported_.before)
    {
        if (!carrier.touch.carry.carries())
            continue;
        const double part = lift_of_touch(carrier) / sum;
        carrier.touch.carry = {0, part * lag};
        carrier.touch.depth = std::max(0.0, part * lag.dot(carrier.touch.normal));
        reported_.now.push_back(carrier);
    }
}

void ContactTracker::report_together(TouchView view)
{
    const bool yields = share_out(view) || held_by_body();
    Vector3 lag = yields ? remaining_lift() : common_ ? lag_at(course_.proxy) : Vector3(Vector3::Zero());
    released_ = released_ && !lag.isZero(0);
    if (released_)
        lag.setZero();
    carries_on_ = report_planes(lag) == 0 && !lag.isZero(0);
    if (carries_on_)
        report_former_carriers(lag);
}

double ContactTracker::yield_at(const SlidePlane &plane) const
{
    const NearbyGeom &geom = *places_[plane.place].geom;
    const double stiffness = geom.material() ? geom.material()->stiffness : stiffness_;
    const double mobility = geom.mobility_at(plane.feature.point, plane.feature.normal);
    return yield_of(stiffness, mobility, std::max(tick_length_, geom.step()));
}

/// Computes the shares of the last slide's planes. If all objects hold the proxy together and one is movable, all
/// yield: exact shares grow without bound where normals are close to dependent, and would throw light bodies. A body
/// that responds only in the next step of the scene always yields.
bool ContactTracker::share_out(TouchView view)
{
    bool yields = false;
    yielding_.clear();
    for (const SlidePlane &plane : slide_.planes())
    {
        const NearbyGeom &geom = *places_[plane.place].geom;
        yields = yields || (geom.is_movable() && (view == TouchView::all_together || geom.step() > tick_length_));
        yielding_.push_back({plane.feature.normal, plane.depth, yield_at(plane), plane.share});
    }
    if (yields)
        find_yielding_place(yielding_);
    return yields;
}

/// @return m; the sum of the shares.
double ContactTracker::report_planes(const Vector3 &lag)
{
    double carried = 0;
    for (const ConstraintPlane &plane : yielding_)
        carried += plane.share;
    for (std::size_t i = 0; i < yielding_.size(); ++i)
    {
        const SlidePlane &plane = slide_.planes()[i];
        const double share = yielding_[i].share;
        const bool touched = share > 0 || (plane.depth > 0 && plane.feature.distance <= radius_ * (1 + in_contact));
        const bool near = plane.depth > -margin_ && plane.feature.distance <= radius_ + margin_;
        if (!touched && !near)
            continue;
        const NearbyGeom &geom = *places_[plane.place].geom;
        Touch touch = geom.touch_of(plane.feature);
        touch.depth = touched ? std::max(0.0, plane.depth) : plane.depth;
        touch.from_entry_side = true;
        touch.carry = {share, carried > 0 ? Vector3(share / carried * lag) : Vector3(Vector3::Zero())};
        touch.is_solved = true;
        reported_.now.push_back({geom.id(), touch});
    }
    return carried;
}

/// Each object holds off the tool alone. The common slide has determined the side of entry.
void ContactTracker::report_each_object()
{
    for (const HeldGeom &first : near_.list())
    {
        const std::uintptr_t object = first.geom.object();
        const auto is_of_it = [&](const HeldGeom &held) { return held.geom.object() == object; };
        if (find_in(near_.list(), is_of_it) != &first)
            continue;
        places_.clear();
        for (const HeldGeom &held : near_.list())
            if (is_of_it(held))
                places_.push_back({&held.geom, held.place.at, 0});
        SphereSlide::Task alone = task();
        alone.longest = std::max(alone.longest, 2 * (course_.proxy - course_.tool).norm());
        alone.reach = std::numeric_limits<double>::infinity();
        alone.triangles = std::max<std::size_t>(1, alone.triangles / near_.list().size());
        const bool common = slide_.run(alone, places_);
        visited_ += alone.triangles - slide_.left();
        share_out(TouchView::each_object_alone);
        report_planes(common ? lag_at(places_.front().at) : Vector3(Vector3::Zero()));
    }
}

} // namespace ode_predictive_space::haptics
