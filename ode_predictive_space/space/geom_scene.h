// ODE's geoms as the broad phase sees them.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_GEOM_SCENE_H
#define ODE_PREDICTIVE_SPACE_SPACE_GEOM_SCENE_H

#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

#include "ode_predictive_space/broadphase/measured_box.h"
#include "ode_predictive_space/broadphase/predictor.h"
#include "ode_predictive_space/broadphase/prefetch.h"
#include "ode_predictive_space/broadphase/ray_probe.h"
#include "ode_predictive_space/broadphase/types.h"
#include "ode_predictive_space/space/ode_internals.h"

namespace ode_predictive_space
{
/// A sphere around a geom's position that holds it, however it is turned.
struct BoundingSphere
{
    double radius;  ///< infinite for classes and geoms for which none is known
    bool is_sphere; ///< the geom is that sphere
};

/// The bounding sphere of a sphere, box, capsule or cylinder; of the latter three only when they turn with a body, because
/// the rotation matrix of other geoms can be anything.
BoundingSphere bounding_sphere(const dxGeom *geom);

static_assert(std::is_same<SceneReal, dReal>::value, "a broad phase for ODE's precision");

/// Where a sphere, box, capsule or cylinder keeps its sizes: right behind the members that all geoms have (ode_mismatch()
/// makes sure of it). To be read without a cast to one of these classes.
static_assert(sizeof(dxBox) == sizeof(dxGeom) + sizeof(dVector3), "nothing is between them");
inline const dReal *sizes_of(const dxGeom *geom)
{
    return reinterpret_cast<const dReal *>(geom + 1);
}

/// Does a geom that has a bounding sphere, as the last look told, still fit into one of this radius? Asked for every moved
/// geom at every tick: classes alternate at random, and where a branch on them would be mispredicted, all are computed. (The
/// margin of bounding_sphere() covers the rounding.)
inline bool fits_into_sphere(const dxGeom *geom, double radius)
{
    static_assert(dSphereClass == 0 && dBoxClass == 1 && dCapsuleClass == 2 && dCylinderClass == 3,
                  "the tables go by class");
    // Which of the sizes behind the members of dxGeom count: (radius), (x, y, z), (radius, length), (radius, length); and
    // the square of the radius by products of these: x x, x y, y y, z z.
    static constexpr std::uint8_t second[4] = {0, 1, 1, 1}, third[4] = {0, 2, 1, 1};
    static constexpr double factors[4][4] = {{1, 0, 0, 0}, {0.25, 0, 0.25, 0.25}, {1, 1, 0.25, 0}, {1, 0, 0.25, 0}};
    const int type = geom->type;
    const dReal *size = sizes_of(geom);
    const double *factor = factors[type];
    const double x = size[0], y = size[second[type]], z = size[third[type]];
    const double squared = x * (factor[0] * x + factor[1] * y) + factor[2] * y * y + factor[3] * z * z;
    return squared <= radius * radius;
}

/// Does a geom, however it turns, turn around its position? Then the bounding sphere that it has, or had when it was last
/// looked at, is one around that still.
inline bool turns_safely(const dxGeom *geom)
{
    return (geom->type == dSphereClass) | ((geom->body != nullptr) & (geom->offset_posr == nullptr));
}

/// The position of a geom, or null when it has to be computed first or is not the centre of a sphere that holds the geom.
inline const dReal *centre_of_sphere(const dxGeom *geom)
{
    return !(geom->gflags & GEOM_POSR_BAD) & turns_safely(geom) ? geom->final_posr->pos : nullptr;
}

/// Can a geom be touched outside of any sphere around its bounding box? ODE makes contacts with a heightfield for what lies
/// beside and below its edge, too; a space or a transform may hold one; and what a user's class does is unknown.
bool judged_by_box_alone(const dxGeom *geom);

/// Can a ray touch a geom whose bounding box its line does not meet? Besides those above, ODE makes contacts between a ray
/// and a convex from its distance to a face, as if it stood at right angles to it.
bool touched_off_line(const dxGeom *geom);

/// The line of a ray; none when it is not finite.
std::optional<RayProbe> line_of_ray(dxGeom *ray);

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

/// A geom that has just been written: what Broadphase asks when a move is noticed.
class NoticedGeom
{
public:
    explicit NoticedGeom(const dxGeom *geom) : geom_(geom) {}

    /// (What has been given an offset from its body has a bad position when it has been moved. What has lost its body turns by
    /// any matrix.)
    bool has_centre() const
    {
        return (geom_->body != nullptr || geom_->type == dSphereClass) && (geom_->gflags & GEOM_POSR_BAD) == 0;
    }
    const dReal *coordinates() const { return geom_->final_posr->pos; }
    bool has_grown(float radius) const { return !fits_into_sphere(geom_, radius); }

    /// Of the position and the beginning of the rotation, which lie together.
    std::uint32_t pose_digest() const
    {
        const dxPosR *pose = geom_->final_posr;
        return low_bits_of(pose->pos[0]) + low_bits_of(pose->pos[1]) + low_bits_of(pose->pos[2]) +
               low_bits_of(pose->R[0]);
    }

private:
    static std::uint32_t low_bits_of(dReal value)
    {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof value);
        return static_cast<std::uint32_t>(bits);
    }

    const dxGeom *geom_;
};

/// The scene that Broadphase asks: geoms by proxy number. See Broadphase for what each function means.
class GeomScene
{
public:
    /// @param geoms by proxy number; must stay where they are as long as the scene is used.
    GeomScene(const std::vector<dxGeom *> &geoms, bool spheres) : geoms_(geoms.data()), spheres_(spheres) {}

    Vector3 position(ProxyId id) const
    {
        dxGeom *geom = geoms_[id];
        geom->recomputePosr();
        const dReal *position = geom->final_posr->pos;
        return Vector3(position[0], position[1], position[2]);
    }

    const dReal *coordinates(ProxyId id) const { return centre_of_sphere(geoms_[id]); }
    bool has_grown(ProxyId id, float radius) const { return !fits_into_sphere(geoms_[id], radius); }

    void prefetch(ProxyId id) const
    {
        constexpr std::size_t most_sizes = 3;
        prefetch_block<sizeof(dxGeom) + most_sizes * sizeof(dReal)>(geoms_[id]);
    }
    void prefetch_pose(ProxyId id) const { prefetch_block<sizeof(dxPosR)>(geoms_[id]->final_posr); }
    void prefetch_velocity(ProxyId id) const
    {
        if (const dBodyID body = geoms_[id]->body)
            prefetch_block<2 * sizeof(dVector3)>(dBodyGetLinearVel(body)); // behind it, the angular velocity
    }

    Box bounds(ProxyId id) const { return to_box(valid_aabb(id)); }
    void measure(ProxyId id, MeasuredBox &box) const { box.assign(valid_aabb(id)); }
    std::optional<Vector3> pivot(ProxyId id) const;
    Observation observe(ProxyId id, bool with_bounds) const;
    bool overlap(ProxyId first, ProxyId second) const { return overlap(geoms_[first], geoms_[second]); }
    bool overlap(dxGeom *one, dxGeom *other) const;

private:
    const dReal *valid_aabb(ProxyId id) const
    {
        dxGeom *geom = geoms_[id];
        if (IS_SPACE(geom))
            static_cast<dxSpace *>(geom)->cleanGeoms();
        geom->recomputeAABB();
        return geom->aabb;
    }

    dxGeom *const *geoms_;
    bool spheres_;
};
} // namespace ode_predictive_space

#endif
