#include "ode_predictive_space/haptics/contact/sphere_slide.h"

#include "ode_predictive_space/haptics/contact/yielding_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int most_steps = 48;
constexpr int most_refinements = 24;
constexpr double short_step = 0.1;     // of the clearance
constexpr double arrived = 1e-9;       // of the radius: a step that is shorter is the last
constexpr double shortest_look = 0.05; // of the radius
constexpr std::size_t searches = 4;    // of a run, when each visits as many triangles as it may
constexpr double shorter_look = 0.125; // after a search that found too many triangles
constexpr double part_of_clearance = 0.9;
constexpr double smallest_step = 1e-6; // of the radius; away from a surface that the centre lies on
constexpr double allowed_entry = 5e-4; // of the radius; how deep a step may bring the sphere into a surface
constexpr double shortest_try = 1e-5;  // of the radius; of a step that entered a surface and is tried again
constexpr double yielding_cell = 1e-3; // of planes that leave no place: what only cancels stays small
constexpr double squeezed = 2;         // times the radius; how far apart geoms that squeeze it see the sphere

/// How far a step may go.
double longest_step(const SlidePlace &place, double look, double radius)
{
    const bool within = place.geom->is_solid() && place.clearance <= 0;
    return within ? radius + look
                  : std::min(look, std::max(part_of_clearance * place.clearance, smallest_step * radius));
}

/// What part of a step that begins in a ball ends in it.
double part_within(const Vector3 &centre, double radius, const Vector3 &from, const Vector3 &to)
{
    const Vector3 start = from - centre;
    const Vector3 way = to - from;
    const double within = radius * radius - start.squaredNorm();
    const double square = way.squaredNorm();
    if (square == 0 || (to - centre).norm() <= radius)
        return 1;
    const double along = start.dot(way);
    return std::clamp((std::sqrt(along * along + square * std::max(0.0, within)) - along) / square, 0.0, 1.0);
}
} // namespace

SphereSlide::SphereSlide()
{
    planes_.reserve(usual_planes);
    constraints_.reserve(usual_planes);
    features_.reserve(usual_planes);
    targets_.reserve(usual_planes);
    planes_before_.reserve(usual_planes);
    places_before_.reserve(usual_planes);
}

bool SphereSlide::run(const Task &task, std::vector<SlidePlace> &places)
{
    const double least = shortest_look * task.radius;
    double look = std::clamp(task.look, least, std::max(least, task.longest));
    double longest = std::numeric_limits<double>::infinity(); // m; of a step
    bool retries = false;                                     // the last step entered a surface
    targets_.resize(places.size());
    left_ = task.triangles;
    double left = search(task, look, places) ? task.longest : 0;
    for (int step = 0; step < most_steps && left > 0 && longest > shortest_try * task.radius; ++step)
    {
        const bool common = find_target(task.goal);
        if (common && !retries)
            refine_target(task, places);
        places_before_ = places;
        const double way = go(common, look, std::min(left, longest), task, places);
        if (way <= arrived * task.radius)
            break;
        double next_look = way < look ? look : std::max(look, std::min(2 * look, left - way));
        if (!search_again(task, next_look, places))
            break;
        retries = common && enters(task, places);
        if (retries)
        {
            places = places_before_;
            keep_entered(task);
            longest = way / 2;
            continue;
        }
        look = next_look;
        left -= way;
        longest *= 2;
    }
    places_before_ = places;
    double margin = task.margin;
    if (look < margin)
        search_again(task, margin, places);
    const bool common = find_target(task.goal);
    for (std::size_t i = 0; i < planes_.size(); ++i)
        planes_[i].share = common ? constraints_[i].share : std::max(0.0, planes_[i].depth);
    if (!common && places.size() == 1)
        share_place(task, places.front());
    return common || places.size() == 1;
}

Vector3 SphereSlide::unhindered(const Task &task)
{
    const Vector3 way = task.goal - task.start;
    const double length = way.norm();
    double part = length > task.longest ? task.longest / length : 1;
    if (task.reach < std::numeric_limits<double>::infinity())
        part = std::min(part, part_within(task.reach_centre, task.reach, task.start, task.goal));
    return part == 1 ? task.goal : Vector3(task.start + part * way);
}

/// A single geom whose planes leave no place holds the sphere where it is. The planes in contact get such shares that they lift as far
/// as there as they can.
void SphereSlide::share_place(const Task &task, const SlidePlace &place)
{
    const Vector3 lift = place.at - task.goal;
    const auto in_contact = [&](const SlidePlane &plane) {
        return plane.feature.distance <= task.radius * (1 + allowed_entry);
    };
    constraints_.clear();
    for (const SlidePlane &plane : planes_)
        if (in_contact(plane))
            constraints_.push_back({plane.feature.normal, plane.feature.normal.dot(lift), yielding_cell});
    find_yielding_place(constraints_);
    auto found = constraints_.begin();
    for (SlidePlane &plane : planes_)
        plane.share = in_contact(plane) ? found++->share : 0;
}

/// Back to the planes before the step, and with them those of what it entered: the next try goes around these.
void SphereSlide::keep_entered(const Task &task)
{
    for (const SlidePlane &plane : planes_)
        if (plane.feature.distance < task.radius)
            planes_before_.push_back(plane);
    planes_.swap(planes_before_);
}

/// Whether the last step brought the sphere into a surface, deeper than it was. What is no local minimum of the distance before
/// a step is no plane, and may be one after it: then a shorter step is due.
bool SphereSlide::enters(const Task &task, const std::vector<SlidePlace> &places) const
{
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        const double clearance = places[i].clearance;
        if (clearance < (1 - allowed_entry) * task.radius && clearance < places_before_[i].clearance)
            return true;
    }
    return false;
}

/// A step of all, to the targets or as far towards them as is safe.
///
/// @return m; the longest way.
double SphereSlide::go(bool common, double look, double most, const Task &task, std::vector<SlidePlace> &places)
{
    double part = 1;
    double longest = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        targets_[i] = common ? target_ : target_of(i, task, places);
        const double way = (targets_[i] - places[i].at).norm();
        const double allowed = std::min(most, longest_step(places[i], look, task.radius));
        part = way > allowed ? std::min(part, allowed / way) : part;
        if (common && task.reach < std::numeric_limits<double>::infinity())
            part = std::min(part, part_within(task.reach_centre, task.reach, places[i].at, targets_[i]));
        longest = std::max(longest, way);
    }
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i].at = part == 1 ? targets_[i] : places[i].at + part * (targets_[i] - places[i].at);
    arrives_ = part == 1;
    return part * longest;
}

/// Gathers what is within a distance ahead, or within a shorter one when there is too much.
///
/// @return false when the triangles are used up.
bool SphereSlide::search(const Task &task, double &look, std::vector<SlidePlace> &places)
{
    const std::size_t at_once = std::max<std::size_t>(1, task.triangles / searches);
    while (left_ > 0)
    {
        if (gather(task, look, std::min(left_, at_once), places))
            return true;
        look *= shorter_look;
    }
    return false;
}

/// After a step, which is taken back when the triangles are used up.
bool SphereSlide::search_again(const Task &task, double &look, std::vector<SlidePlace> &places)
{
    planes_.swap(planes_before_);
    if (search(task, look, places))
        return true;
    planes_.swap(planes_before_);
    places = places_before_;
    return false;
}

/// @return false when there are more triangles: then planes are missing.
bool SphereSlide::gather(const Task &task, double look, std::size_t most, std::vector<SlidePlace> &places)
{
    planes_.clear();
    MeshTree::Budget budget(most);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        features_.clear();
        SlidePlace &place = places[i];
        place.clearance = place.geom->collect(place.at, task.radius + look, features_, &budget);
        for (const SurfaceFeature &feature : features_)
            planes_.push_back({i, feature, task.radius - feature.normal.dot(task.goal - feature.point), 0});
    }
    left_ -= most - budget.left();
    return !budget.is_exceeded();
}

bool SphereSlide::find_target(const Vector3 &goal)
{
    constraints_.clear();
    for (const SlidePlane &plane : planes_)
        constraints_.push_back({plane.feature.normal, plane.depth});
    const bool found = find_closest_point(constraints_);
    target_ = goal + lift_of(constraints_);
    return found;
}

/// The planes that carry the sphere at the target, as they are from there. @return whether there is a place.
bool SphereSlide::turn_planes(const Task &task, const std::vector<SlidePlace> &places)
{
    for (std::size_t i = 0; i < planes_.size(); ++i)
    {
        if (constraints_[i].share > 0)
        {
            const SlidePlane &plane = planes_[i];
            const SurfaceFeature seen = places[plane.place].geom->nearest_of(plane.feature, target_);
            constraints_[i].normal = seen.normal;
            constraints_[i].depth = task.radius - seen.normal.dot(task.goal - seen.point);
        }
    }
    return find_closest_point(constraints_);
}

/// To the target: so short that all surfaces are nearly as far from there as from here, and to the same side.
bool SphereSlide::is_short_step(const std::vector<SlidePlace> &places) const
{
    return std::all_of(places.begin(), places.end(), [&](const SlidePlace &place) {
        return (target_ - place.at).norm() <= short_step * place.clearance;
    });
}

/// Around an edge the steps alone would come nearer by the same factor each time: depth over radius. A turned plane allows
/// places behind the plane that it replaces. This is safe for a short step, because the next step meets what is there. On a flat face of which only
/// edges are found, each turned plane leads farther away: then the target stays as it was.
void SphereSlide::refine_target(const Task &task, const std::vector<SlidePlace> &places)
{
    const Vector3 unrefined = target_;
    double change = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_refinements && is_short_step(places) && turn_planes(task, places); ++i)
    {
        const Vector3 last = target_;
        target_ = task.goal + lift_of(constraints_);
        const double change_before = std::exchange(change, (target_ - last).norm());
        if (change <= arrived * task.radius)
            break;
        if (change > change_before)
        {
            target_ = unrefined;
            break;
        }
    }
    target_ = is_short_step(places) ? target_ : unrefined;
}

/// Where the sphere would go if there were this geom alone; if even that leaves no place, it stays. Not all the way to the
/// goal: the other geoms hold the sphere.
Vector3 SphereSlide::target_of(std::size_t place, const Task &task, const std::vector<SlidePlace> &places)
{
    const Vector3 way = task.goal - task.start;
    const double length = way.norm(), most = squeezed * task.radius;
    const Vector3 goal = length > most ? Vector3(task.start + most / length * way) : task.goal;
    constraints_.clear();
    for (const SlidePlane &plane : planes_)
    {
        const Vector3 &normal = plane.feature.normal;
        if (plane.place == place)
            constraints_.push_back({normal, plane.depth + normal.dot(task.goal - goal)});
    }
    return find_closest_point(constraints_) ? goal + lift_of(constraints_) : places[place].at;
}
} // namespace ode_predictive_space::haptics
