#include "ode_predictive_space/haptics/contact/sphere_slide.h"

#include "ode_predictive_space/haptics/closest_point.h"

#include <algorithm>
#include <limits>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int most_steps = 48;
constexpr double arrived = 1e-9;       // of the radius: a step that is shorter is the last
constexpr double shortest_look = 0.05; // of the radius
constexpr double part_of_clearance = 0.9;
constexpr double smallest_step = 1e-6; // of the radius; away from a surface that the centre lies on
constexpr int most_sweeps = 200;
constexpr std::size_t usual_planes = 256;
constexpr double allowed_violation = 1e-6; // of the deepest plane

/// Hildreth's method: slower than find_closest_point() and less exact, but never confused by normals that are nearly dependent.
bool find_by_sweeps(std::vector<ConstraintPlane> &planes)
{
    double deepest = 0;
    for (ConstraintPlane &plane : planes)
    {
        deepest = std::max(deepest, plane.depth);
        plane.share = 0;
    }
    Vector3 lift = Vector3::Zero();
    for (int sweep = 0; sweep < most_sweeps; ++sweep)
    {
        double worst = 0;
        for (ConstraintPlane &plane : planes)
        {
            const double missing = plane.depth - plane.normal.dot(lift);
            const double share = std::max(0.0, plane.share + missing);
            worst = std::max(worst, missing);
            lift += (share - plane.share) * plane.normal;
            plane.share = share;
        }
        if (worst <= allowed_violation * deepest)
        {
            return true;
        }
    }
    return false;
}

/// @return whether there is a place; the shares say where.
bool find_place(std::vector<ConstraintPlane> &planes)
{
    return find_closest_point(planes) || find_by_sweeps(planes);
}

Vector3 lift_of(const std::vector<ConstraintPlane> &planes)
{
    Vector3 lift = Vector3::Zero();
    for (const ConstraintPlane &plane : planes)
    {
        lift += plane.share * plane.normal;
    }
    return lift;
}

ConstraintPlane constraint_of(const SlidePlane &plane)
{
    ConstraintPlane constraint;
    constraint.normal = plane.feature.normal;
    constraint.depth = plane.depth;
    return constraint;
}

/// How far a step may go.
double longest_step(const SlidePlace &place, double look, double radius)
{
    const bool within = place.geom->is_solid() && place.clearance <= 0;
    return within ? radius + look
                  : std::min(look, std::max(part_of_clearance * place.clearance, smallest_step * radius));
}
} // namespace

SphereSlide::SphereSlide()
{
    planes_.reserve(usual_planes);
    constraints_.reserve(usual_planes);
    features_.reserve(usual_planes);
    targets_.reserve(usual_planes);
}

bool SphereSlide::run(const Task &task, std::vector<SlidePlace> &places)
{
    double look = std::max(task.look, shortest_look * task.radius);
    double left = task.longest;
    targets_.resize(places.size());
    for (int step = 0; step < most_steps && left > 0; ++step)
    {
        gather(task, look, places);
        const bool common = find_target(task.goal);
        double part = 1;
        double longest = 0;
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            targets_[i] = common ? target_ : target_of(i, task, places);
            const double way = (targets_[i] - places[i].at).norm();
            const double allowed = std::min(left, longest_step(places[i], look, task.radius));
            part = way > allowed ? std::min(part, allowed / way) : part;
            longest = std::max(longest, way);
        }
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            places[i].at = part == 1 ? targets_[i] : places[i].at + part * (targets_[i] - places[i].at);
        }
        left -= part * longest;
        if (part * longest <= arrived * task.radius)
        {
            look = shortest_look * task.radius;
            break;
        }
        look *= part < 1 ? 2 : 1;
    }
    gather(task, std::max(task.margin, look), places); // on its way still, it is carried by what it goes to
    const bool common = find_target(task.goal);
    for (std::size_t i = 0; i < planes_.size(); ++i)
    {
        planes_[i].share = common ? constraints_[i].share : std::max(0.0, planes_[i].depth);
    }
    return common;
}

void SphereSlide::gather(const Task &task, double look, std::vector<SlidePlace> &places)
{
    planes_.clear();
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        features_.clear();
        SlidePlace &place = places[i];
        place.clearance = place.geom->collect(place.at, task.radius + look, features_);
        for (const SurfaceFeature &feature : features_)
        {
            planes_.push_back({i, feature, task.radius - feature.normal.dot(task.goal - feature.point), 0});
        }
    }
}

bool SphereSlide::find_target(const Vector3 &goal)
{
    constraints_.clear();
    for (const SlidePlane &plane : planes_)
    {
        constraints_.push_back(constraint_of(plane));
    }
    const bool found = find_place(constraints_);
    target_ = goal + lift_of(constraints_);
    return found;
}

/// Where the sphere would go if there were this geom alone; if even that leaves no place, it stays.
Vector3 SphereSlide::target_of(std::size_t place, const Task &task, const std::vector<SlidePlace> &places)
{
    constraints_.clear();
    for (const SlidePlane &plane : planes_)
    {
        if (plane.place == place)
        {
            constraints_.push_back(constraint_of(plane));
        }
    }
    return find_place(constraints_) ? task.goal + lift_of(constraints_) : places[place].at;
}
} // namespace ode_predictive_space::haptics
