// ODE's conditions for calling back for a pair, beside the overlap of its boxes.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_PAIR_FILTER_H
#define ODE_PREDICTIVE_SPACE_SPACE_PAIR_FILTER_H

#include <algorithm>

#include "ode_predictive_space/broadphase/base/prefetch.h"
#include "ode_predictive_space/space/geom_scene.h"

namespace ode_predictive_space
{
// The two cache lines of a geom that the filters read.
inline void prefetch_filters(const dxGeom *geom)
{
    prefetch(&geom->gflags);
    prefetch(&geom->category_bits);
}

// The box test of user classes. ODE's own classes add nothing to the test of the bounding boxes.
[[gnu::noinline]] inline bool user_classes_agree(dxGeom *first, dxGeom *second)
{
    return (first->type < dFirstUserClass || first->AABBTest(second, second->aabb) != 0) &&
           (second->type < dFirstUserClass || second->AABBTest(first, first->aabb) != 0);
}

// ODE's colliders read the bounding boxes of both geoms when one is of a later class: a convex, a mesh, a heightfield.
constexpr int last_class_without_box = dRayClass;
static_assert(dSphereClass < dBoxClass && dBoxClass < dCapsuleClass && dCapsuleClass < dCylinderClass &&
              dCylinderClass < dPlaneClass && dPlaneClass < dRayClass && dRayClass < dConvexClass);

// This function and the next have the conditions of ODE's collideAABBs() beside overlap. Bits and bodies change without notice, so
// they are read at each report. The bits come first: they exclude most pairs that always overlap, such as walls at their edges.
inline bool bits_agree(const dxGeom *first, const dxGeom *second)
{
    return ((first->category_bits & second->collide_bits) | (second->category_bits & first->collide_bits)) != 0;
}

inline bool wants_callback(dxGeom *first, dxGeom *second)
{
    if (first->body == second->body && first->body)
        return false;
    const int last_class = std::max(first->type, second->type);
    if (last_class <= last_class_without_box)
        return true;
    compute_box_beside_others(first);
    compute_box_beside_others(second);
    return last_class < dFirstUserClass || user_classes_agree(first, second);
}
} // namespace ode_predictive_space

#endif
