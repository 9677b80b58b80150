// ODE's geoms as objects of the broad phase. In: numbers of objects. Out: positions, boxes and motion of their geoms.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_GEOM_SCENE_H
#define ODE_PREDICTIVE_SPACE_SPACE_GEOM_SCENE_H

#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/index/ray_probe.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/space/hull_store.h"
#include "ode_predictive_space/space/ode_internals.h"

namespace ode_predictive_space
{
/// Radius of a sphere around the position of a sphere, box, capsule or cylinder that holds it by any rotation; else infinite.
double circumscribed_radius(const dxGeom *geom);

/// Formula and sizes of the bounding box from the pose, as in ODE: spheres, boxes, capsules, in double precision cylinders.
Solid solid_of(const dxGeom *geom);

/// The sizes of a sphere, box, capsule or cylinder, which follow the members of dxGeom (ode_mismatch() checks this).
static_assert(sizeof(dxBox) == sizeof(dxGeom) + sizeof(dVector3), "nothing is between them");
inline const dReal *sizes_of(const dxGeom *geom)
{
    return reinterpret_cast<const dReal *>(geom + 1);
}

/// Is a geom with these flags enabled, and has it a size?
inline bool enabled(int flags)
{
    return (flags & GEOM_ENABLE_TEST_MASK) == GEOM_ENABLE_TEST_VALUE;
}
inline bool enabled(const dxGeom *geom)
{
    return enabled(geom->gflags);
}
/// This runs once per reported pair, so it has no branch, which saves 0.9 % in floor 500.
inline bool both_enabled(const dxGeom *one, const dxGeom *other)
{
    const int off = (one->gflags ^ GEOM_ENABLE_TEST_VALUE) | (other->gflags ^ GEOM_ENABLE_TEST_VALUE);
    return (off & GEOM_ENABLE_TEST_MASK) == 0;
}

/// The flags of a geom whose bounding box another thread may be computing. Without GEOM_AABB_BAD, the box can be read.
inline int flags_beside_others(const dxGeom *geom)
{
    return __atomic_load_n(&geom->gflags, __ATOMIC_ACQUIRE);
}

/// Computes a bad bounding box, and publishes the new flags to flags_beside_others(). At most one thread at a time per geom.
inline void compute_box_beside_others(dxGeom *geom)
{
    if (!(geom->gflags & GEOM_AABB_BAD))
        return;
    if (geom->gflags & GEOM_POSR_BAD)
        geom->computePosr();
    geom->computeAABB();
    __atomic_store_n(&geom->gflags, geom->gflags & ~(GEOM_POSR_BAD | GEOM_AABB_BAD), __ATOMIC_RELEASE);
}

/// The bounding box, computed if necessary, also of a space with moved geoms. At most one thread at a time per geom.
const dReal *valid_aabb(dxGeom *geom);

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

/// Compares as ODE's collideAABBs(), so that touching boxes and NaN give the same result. @pre the boxes are valid.
inline bool aabbs_overlap(const dxGeom *one, const dxGeom *other)
{
    const dReal *a = one->aabb, *b = other->aabb;
    return !(a[0] > b[1] || a[1] < b[0] || a[2] > b[3] || a[3] < b[2] || a[4] > b[5] || a[5] < b[4]);
}

inline Box to_box(const dReal aabb[6])
{
    return Box(Vector3(aabb[0], aabb[2], aabb[4]), Vector3(aabb[1], aabb[3], aabb[5]));
}

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
