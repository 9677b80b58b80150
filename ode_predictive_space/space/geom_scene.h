// ODE's geoms as the broad phase sees them. In: numbers of objects. Out: positions, boxes and motion of their geoms.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_GEOM_SCENE_H
#define ODE_PREDICTIVE_SPACE_SPACE_GEOM_SCENE_H

#include <cstdint>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/index/ray_probe.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/space/hull_store.h"
#include "ode_predictive_space/space/ode_internals.h"
#include "ode_predictive_space/space/rotation.h"

namespace ode_predictive_space
{
/// Radius of the sphere around the position of a sphere, box, capsule or cylinder that holds the geom if its matrix is a rotation;
/// infinite for other classes.
double circumscribed_radius(const dxGeom *geom);

/// A geom whose pose is known, and whose bounding box follows from its pose by a formula that ODE shares.
Solid solid_of(const dxGeom *geom);

/// The sizes of a sphere, box, capsule or cylinder. They lie right behind the members that all geoms have (ode_mismatch() checks
/// this), and can be read without knowing the geom's class.
static_assert(sizeof(dxBox) == sizeof(dxGeom) + sizeof(dVector3), "nothing is between them");
inline const dReal *sizes_of(const dxGeom *geom)
{
    return reinterpret_cast<const dReal *>(geom + 1);
}

bool turns_safely_at_offset(const dxGeom *geom);

/// Does the geom turn about its position? Then a bounding sphere that was measured earlier still holds it.
inline bool turns_safely(const dxGeom *geom)
{
    if (geom->offset_posr)
        return turns_safely_at_offset(geom);
    return geom->type == dSphereClass || (geom->body && keeps_within_sphere(geom->final_posr->R));
}

/// Does a geom with these flags take part in collisions? It must be enabled and have a size.
inline bool enabled(int flags)
{
    return (flags & GEOM_ENABLE_TEST_MASK) == GEOM_ENABLE_TEST_VALUE;
}
inline bool enabled(const dxGeom *geom)
{
    return enabled(geom->gflags);
}
inline bool both_enabled(const dxGeom *one, const dxGeom *other)
{
    const int off = (one->gflags ^ GEOM_ENABLE_TEST_VALUE) | (other->gflags ^ GEOM_ENABLE_TEST_VALUE);
    return (off & GEOM_ENABLE_TEST_MASK) == 0;
}

/// The flags of a geom whose bounding box another thread may be computing. When they say that the box is good, it can be read.
inline int flags_beside_others(const dxGeom *geom)
{
    return __atomic_load_n(&geom->gflags, __ATOMIC_ACQUIRE);
}

/// Computes the bounding box if it is bad, as dxGeom::recomputeAABB() does; flags_beside_others() tells other threads when it is
/// done. Only one thread at a time may do this for a geom.
inline void compute_box_beside_others(dxGeom *geom)
{
    if (!(geom->gflags & GEOM_AABB_BAD))
        return;
    if (geom->gflags & GEOM_POSR_BAD)
        geom->computePosr();
    geom->computeAABB();
    __atomic_store_n(&geom->gflags, geom->gflags & ~(GEOM_POSR_BAD | GEOM_AABB_BAD), __ATOMIC_RELEASE);
}

/// The bounding box, valid also for spaces whose geoms have moved. Only one thread at a time may do this for a geom.
const dReal *valid_aabb(dxGeom *geom);

/// Can the geom be touched outside of a sphere around its bounding box? ODE makes contacts with a heightfield beside and below
/// its edge, too; a space or a transform may hold a heightfield; and user classes are unknown.
bool judged_by_box_alone(const dxGeom *geom);

/// Is the matrix of a geom other than a sphere no rotation? The pose must be valid.
bool is_skewed(const dxGeom *geom);

/// Can a ray touch the geom without meeting its bounding box? Besides the classes above this holds for convexes: ODE computes
/// the contact from the distance to a face, as if the ray were perpendicular to it; and for geoms whose matrix is no rotation.
bool touched_off_line(const dxGeom *geom);

/// The line of a ray from the origin; none when it is not finite.
std::optional<RayProbe> line_of_ray(dxGeom *ray, const Origin &origin);

/// Can this ray touch the geom? The boxes must be valid.
bool line_may_touch(dxGeom *ray, const dxGeom *geom);

/// Can a ray touch the geom? Any other probe can. The boxes must be valid.
inline bool ray_may_touch(dxGeom *probe, const dxGeom *geom)
{
    return probe->type != dRayClass || line_may_touch(probe, geom);
}

/// Do the spheres of the sphere test overlap? The boxes must be valid.
bool spheres_may_touch(const dxGeom *one, const dxGeom *other);

/// Do the bounding boxes, which must be valid, overlap? The comparisons are those of ODE's collideAABBs(), so that touching
/// and NaN mean the same.
inline bool aabbs_overlap(const dxGeom *one, const dxGeom *other)
{
    const dReal *a = one->aabb, *b = other->aabb;
    return !(a[0] > b[1] || a[1] < b[0] || a[2] > b[3] || a[3] < b[2] || a[4] > b[5] || a[5] < b[4]);
}

inline Box to_box(const dReal aabb[6])
{
    return Box(Vector3(aabb[0], aabb[2], aabb[4]), Vector3(aabb[1], aabb[3], aabb[5]));
}

/// The geoms of a space, by number.
class GeomScene : public Scene
{
public:
    /// @param geoms by number; must stay where they are as long as the scene is used.
    /// @param hulls of convexes, meshes and heightfields.
    /// @param steps that may be made for these; see HullMaker::go_on().
    /// @param by_sphere a pair overlaps only when the bounding spheres overlap, too.
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
    void find_disabled(const ProxyId *ids, std::size_t count, std::vector<ProxyId> &disabled) override;

    /// Do the geoms overlap by the test of proximity of the space?
    bool overlap(dxGeom *one, dxGeom *other) const
    {
        compute_box_beside_others(one);
        compute_box_beside_others(other);
        return aabbs_overlap(one, other) && (!by_sphere_ || spheres_overlap(one, other));
    }

    /// Prefetches for reading a bounding box soon: call both in this order, some time apart.
    void prefetch_geom(ProxyId id) const;
    void prefetch_pose(ProxyId id) const;

private:
    static bool spheres_overlap(dxGeom *one, dxGeom *other);
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
