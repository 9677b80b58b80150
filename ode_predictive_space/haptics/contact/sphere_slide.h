// The path of a sphere to a goal around obstacles: the god object of Zilles and Salisbury (1995), swept as in Ruspini,
// Kolarov and Khatib (1997).

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SPHERE_SLIDE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SPHERE_SLIDE_H

#include "ode_predictive_space/haptics/contact/closest_point.h"
#include "ode_predictive_space/haptics/contact/nearby_geom.h"

#include <limits>

namespace ode_predictive_space::haptics
{
/// The sphere's centre beside one geom. The places differ only while geoms move or squeeze the sphere.
struct SlidePlace
{
    const NearbyGeom *geom = nullptr;
    Vector3 at = Vector3::Zero(); ///< m; outside of the geom
    double clearance = 0;         ///< m; from the centre to the surface
};

struct SlidePlane
{
    std::size_t place = 0; ///< index of the geom's place
    SurfaceFeature feature;
    double depth = 0; ///< m; of the goal behind the plane of contact of the sphere's centre
    double share = 0; ///< m; part of the lift from the goal; 0 if the plane does not carry the sphere
};

/// Each step takes the nearby surfaces as planes, and moves to the allowed place nearest to the goal. A triangle lies
/// behind the plane of its nearest point, so the planes forbid too much rather than too little, and the next step
/// refines them. Around an edge, the carrying planes are turned before a short step. A step is shorter than the
/// distance to the nearest surface, so nothing is passed. The steps end at a local minimum of the distance to the goal.
class SphereSlide
{
public:
    struct Task
    {
        double radius = 0; ///< m
        Vector3 goal = Vector3::Zero();
        Vector3 start = Vector3::Zero();                        ///< m; the centre
        double look = 0;                                        ///< m; initial distance of the search
        double longest = 0;                                     ///< m; maximum of the whole displacement
        Vector3 reach_centre = Vector3::Zero();                 ///< m; a common place stays in this ball
        double reach = std::numeric_limits<double>::infinity(); ///< m
        double margin = 0;                      ///< m; planes() includes surfaces up to this distance from the sphere
        std::size_t triangles = most_triangles; ///< budget
    };

    /// Takes less than a millisecond. Counts, not times, bound a run, so that replays agree.
    static constexpr std::size_t most_triangles = 4000;

    static constexpr std::size_t usual_planes = 256; ///< in planes(); rarely exceeded

    /// Reserves memory: up to usual_planes, run() does not allocate.
    SphereSlide();

    /// Dense meshes reduce the search distance and the steps. When the budget is used up, the sphere stops, and the next run
    /// continues. The places are the centre at the beginning and, on return, at the end.
    /// @return whether all geoms allow a common place; otherwise each has its own.
    bool run(const Task &task, std::vector<SlidePlace> &places);

    static Vector3 unhindered(const Task &task);

    std::size_t left() const { return left_; }

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
    std::vector<SlidePlane> planes_before_; ///< before the last step
    std::vector<SlidePlace> places_before_; ///< the same
    std::vector<ConstraintPlane> constraints_;
    SurfaceFeatures features_;
    std::vector<Vector3> targets_;
    Vector3 target_ = Vector3::Zero();
    std::size_t left_ = 0; ///< remaining budget of triangles
};
} // namespace ode_predictive_space::haptics

#endif
