// Sizes, flags and bounding boxes of ODE's geoms.

#ifndef ODE_PREDICTIVE_SPACE_ODE_GEOM_ACCESS_H
#define ODE_PREDICTIVE_SPACE_ODE_GEOM_ACCESS_H

#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
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
inline const dReal *valid_aabb(dxGeom *geom)
{
    if (IS_SPACE(geom))
        static_cast<dxSpace *>(geom)->cleanGeoms();
    compute_box_beside_others(geom);
    return geom->aabb;
}

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
} // namespace ode_predictive_space

#endif
