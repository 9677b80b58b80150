// The way of a sphere to a goal, around what lies between: the god object of Zilles and Salisbury (1995), swept as in
// Ruspini, Kolarov and Khatib (1997).

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SPHERE_SLIDE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SPHERE_SLIDE_H

#include "ode_predictive_space/haptics/contact/closest_point.h"
#include "ode_predictive_space/haptics/contact/nearby_geom.h"

#include <limits>

namespace ode_predictive_space::haptics
{
/// Where the sphere's centre is, as one geom sees it. All see the same place but while geoms move or squeeze the sphere.
struct SlidePlace
{
    const NearbyGeom *geom = nullptr;
    Vector3 at = Vector3::Zero(); ///< m; outside of the geom
    double clearance = 0;         ///< m; the centre's distance to the surface
};

/// A feature that the sphere must stay out of, as a plane through its place of contact.
struct SlidePlane
{
    std::size_t place = 0; ///< which geom's, by its index
    SurfaceFeature feature;
    double depth = 0; ///< m; how far the goal is behind the plane on which the sphere's centre would be in contact
    double share = 0; ///< m; of the way from the goal to the sphere's centre; 0 if it does not carry it
};

/// Each step takes the surfaces near the centre as planes, and goes to the place that is nearest to the goal and behind none
/// of them. A triangle lies wholly behind the plane of its nearest place, so the planes forbid too much rather than too
/// little; the next step has better ones; around an edge, if the step is short, the planes that carry the sphere are turned
/// before it. No step is as long as the way to the nearest surface, so that none passes anything. The steps end at a local
/// minimum of the distance to the goal.
class SphereSlide
{
public:
    struct Task
    {
        double radius = 0; ///< m
        Vector3 goal = Vector3::Zero();
        Vector3 start = Vector3::Zero();        ///< m; where the centre is: each geom has a place around there
        double look = 0;                        ///< m; how far ahead surfaces are looked for at first
        double longest = 0;                     ///< m; the longest way altogether
        Vector3 reach_centre = Vector3::Zero(); ///< m; a place that all geoms see stays in this ball
        double reach = std::numeric_limits<double>::infinity(); ///< m; its radius
        double margin = 0;                                      ///< m; planes() has what is so far from the sphere, too
        std::size_t triangles = most_triangles;                 ///< that may be visited
    };

    /// So many are visited in less than a millisecond. Counts, not times, bound a run, so that a replay is the same.
    static constexpr std::size_t most_triangles = 4000;

    static constexpr std::size_t usual_planes = 256; ///< in planes(), rarely more

    /// Makes room for what a tick usually needs: up to that run() does not allocate.
    SphereSlide();

    /// Where there are many triangles, surfaces are looked for less far ahead, and steps are shorter. When the triangles are used up, the
    /// sphere has gone part of its way, and the next run continues.
    ///
    /// @param places where the centre is; then, where it came to.
    /// @return whether there is a place that all geoms allow. Else each of them has one for itself.
    bool run(const Task &task, std::vector<SlidePlace> &places);

    /// Where the sphere goes when no geom is near.
    static Vector3 unhindered(const Task &task);

    /// How many of the task's triangles the last run() did not visit.
    std::size_t left() const { return left_; }

    /// What is near in the end.
    const std::vector<SlidePlane> &planes() const { return planes_; }

private:
    double go(bool common, double look, double most, const Task &task, std::vector<SlidePlace> &places);
    bool search(const Task &task, double &look, std::vector<SlidePlace> &places);
    bool search_again(const Task &task, double &look, std::vector<SlidePlace> &places);
    bool gather(const Task &task, double look, std::size_t most, std::vector<SlidePlace> &places);
    void share_place(const Task &task, const SlidePlace &place);
    bool enters(const Task &task, const std::vector<SlidePlace> &places) const;
    void keep_entered(const Task &task);
    bool find_target(const Vector3 &goal);
    bool turn_planes(const Task &task, const std::vector<SlidePlace> &places);
    bool is_short_step(const std::vector<SlidePlace> &places) const;
    void refine_target(const Task &task, const std::vector<SlidePlace> &places);
    Vector3 target_of(std::size_t place, const Task &task, const std::vector<SlidePlace> &places);

    std::vector<SlidePlane> planes_;
    std::vector<SlidePlane> planes_before_; ///< the last step
    std::vector<SlidePlace> places_before_; ///< the same
    std::vector<ConstraintPlane> constraints_;
    SurfaceFeatures features_;
    std::vector<Vector3> targets_;
    Vector3 target_ = Vector3::Zero();
    std::size_t left_ = 0; ///< triangles that may still be visited
    bool arrives_ = false; ///< the last step went to the targets
};
} // namespace ode_predictive_space::haptics

#endif
