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
constexpr std::size_t searches = 4;    // of a run, if each visits its maximum of triangles
constexpr double shorter_look = 0.125; // after a search that found too many triangles
constexpr double part_of_clearance = 0.9;
constexpr double smallest_step = 1e-6; // of the radius; away from a surface that the centre lies on
constexpr double allowed_entry = 5e-4; // of the radius; how deep a step may bring the sphere into a surface
constexpr double shortest_try = 1e-5;  // of the radius; of a step that entered a surface and is tried again
constexpr double yielding_cell = 1e-3; // of planes that leave no place; keeps opposing shares small
constexpr double squeezed = 2;         // radii; distance between the places of geoms that squeeze the sphere

double longest_step(const SlidePlace &place, double look, double radius)
{
    const bool within = place.geom->is_solid() && place.clearance <= 0;
    return within ? radius + look
                  : std::min(look, std::max(part_of_clearance * place.clearance, smallest_step * radius));
}

/// The part of a step, 0 to 1, that stays in a ball in which it begins.
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

/// A single geom whose planes leave no place holds the sphere where it is. The planes in contact get shares whose lift
/// comes nearest to this place.
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

/// Returns to the planes before the step, plus those of entered surfaces, so that the next try avoids them.
void SphereSlide::keep_entered(const Task &task)
{
    for (const SlidePlane &plane : planes_)
        if (plane.feature.distance < task.radius)
            planes_before_.push_back(plane);
    planes_.swap(planes_before_);
}

/// Whether the last step moved the sphere deeper into a surface. A place that is no local minimum of the distance
/// before a step can become one after it; then a shorter step is needed.
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

/// Moves all places to their targets, or towards them as far as is safe.
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
    return part * longest;
}

/// Gathers surfaces within the search distance, which is reduced if there are too many.
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

/// Searches after a step, which is undone when the budget is used up.
bool SphereSlide::search_again(const Task &task, double &look, std::vector<SlidePlace> &places)
{
    planes_.swap(planes_before_);
    if (search(task, look, places))
        return true;
    planes_.swap(planes_before_);
    places = places_before_;
    return false;
}

/// @return false when triangles, and so planes, are missing.
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

/// Evaluates the carrying planes at the target. @return whether a place exists.
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

/// Whether the step to the target is so short that distances and sides of all surfaces stay about the same.
bool SphereSlide::is_short_step(const std::vector<SlidePlace> &places) const
{
    return std::all_of(places.begin(), places.end(), [&](const SlidePlace &place) {
        return (target_ - place.at).norm() <= short_step * place.clearance;
    });
}

/// Around an edge, plain steps converge slowly, by the factor depth / radius. A turned plane allows places behind the
/// plane that it replaces, which is safe for a short step because the next step finds the surfaces there. On a flat
/// face whose edges alone are found, turned planes diverge; then the target is kept.
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

/// The target with this geom alone; without one, the sphere stays. The distance is bounded, because the other geoms
/// hold the sphere.
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
