// ODE's geoms as objects of the broad phase. In: numbers of objects. Out: positions, boxes and motion of their geoms.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_GEOM_SCENE_H
#define ODE_PREDICTIVE_SPACE_SPACE_GEOM_SCENE_H

#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/index/ray_probe.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/ode/geom_access.h"
#include "ode_predictive_space/space/hull_store.h"

namespace ode_predictive_space
{
/// Radius of a sphere around the position of a sphere, box, capsule or cylinder that holds it by any rotation; else infinite.
double circumscribed_radius(const dxGeom *geom);

/// Formula and sizes of the bounding box from the pose, as in ODE: spheres, boxes, capsules, in double precision cylinders.
Solid solid_of(const dxGeom *geom);

/// Can the geom be touched outside a sphere around its bounding box? ODE also makes contacts beside and below the edge of a
/// heightfield, which a space or a transform may contain; user classes are unknown.
bool judged_by_box_alone(const dxGeom *geom);

/// Is the geom's matrix no rotation? Always false for spheres and planes. @pre the pose is valid.
bool is_skewed(const dxGeom *geom);

/// Can a ray touch the geom without meeting its bounding box? It can if the geom is judged_by_box_alone() or is_skewed(), and
/// if it is a convex: ODE computes that contact from the distance to a face, as if the ray were perpendicular to it.
bool touched_off_line(const dxGeom *geom);

/// The line of a ray, relative to the origin; none if it is not finite.
std::optional<RayProbe> line_of_ray(dxGeom *ray, const Origin &origin);

/// Can the line of the probe touch the geom? True if the probe is no ray. @pre the boxes are valid.
bool ray_may_touch(dxGeom *probe, const dxGeom *geom);

/// The sphere test of proximity, without the boxes; true for pairs that only boxes can judge. @pre the boxes are valid.
bool spheres_may_touch(const dxGeom *one, const dxGeom *other);

class GeomScene : public Scene
{
public:
    /// @param geoms by number; the array must not move while the scene is used.
    /// @param steps available for making hulls; see HullMaker::go_on().
    /// @param by_sphere pairs overlap only if their bounding spheres overlap, too.
    GeomScene(const std::vector<dxGeom *> &geoms, HullStore &hulls, std::size_t steps, bool by_sphere)
        : geoms_(geoms.data()), hulls_(hulls), steps_left_(steps),
          overflows_cache_(geoms.size() > tuning::cached_objects), by_sphere_(by_sphere)
    {}

    void measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin) override;
    void observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &origin) override;
    bool is_in_double_precision() const override { return sizeof(dReal) == sizeof(double); }
    void follow(const ProxyId *ids, std::size_t count, ConvexShape *const *shapes, double *moves) override;
    bool hull_is_outdated(ProxyId id, const ConvexShape &shape) override;
    Box bounds(ProxyId id) override;
    SampledPose pose(ProxyId id) override;
    bool overlap(ProxyId first, ProxyId second) override { return overlap(geoms_[first], geoms_[second]); }
    bool is_excluded(ProxyId first, ProxyId second) override;
    void find_disabled(const std::vector<ProxyId> &ids, IdSet &disabled) override;

    /// Do the bounding boxes overlap and, if the scene is by sphere, the spheres of the sphere test, too?
    bool overlap(dxGeom *one, dxGeom *other) const
    {
        compute_box_beside_others(one);
        compute_box_beside_others(other);
        if (!aabbs_overlap(one, other))
            return false;
        return !by_sphere_ || (spheres_may_touch(one, other) && ray_may_touch(one, other) && ray_may_touch(other, one));
    }

    /// Prefetch a geom and, some time later, its pose, before its bounding box is read.
    void prefetch_geom(ProxyId id) const;
    void prefetch_pose(ProxyId id) const;

private:
    template <typename Visit, typename... Fetches>
    void for_each(std::size_t count, Visit visit, Fetches... fetches) const;
    Observation observation(ProxyId id, const Origin &origin);

    dxGeom *const *geoms_;
    HullStore &hulls_;
    std::size_t steps_left_;
    bool overflows_cache_;
    bool by_sphere_;
};
} // namespace ode_predictive_space

#endif
