// ODE's conditions for a callback, other than the overlap of boxes.

#ifndef ODE_PREDICTIVE_SPACE_ODE_PAIR_FILTER_H
#define ODE_PREDICTIVE_SPACE_ODE_PAIR_FILTER_H

#include <algorithm>

#include "ode_predictive_space/ode/geom_access.h"

namespace ode_predictive_space
{
// ODE's own classes have no box test beyond the overlap of bounding boxes.
[[gnu::noinline]] inline bool user_classes_agree(dxGeom *first, dxGeom *second)
{
    return (first->type < dFirstUserClass || first->AABBTest(second, second->aabb) != 0) &&
           (second->type < dFirstUserClass || second->AABBTest(first, first->aabb) != 0);
}

// ODE's colliders read the bounding boxes of both geoms when one is of a later class: a convex, a mesh, a heightfield.
constexpr int last_class_without_box = dRayClass;
static_assert(dSphereClass < dBoxClass && dBoxClass < dCapsuleClass && dCapsuleClass < dCylinderClass &&
              dCylinderClass < dPlaneClass && dPlaneClass < dRayClass && dRayClass < dConvexClass);

// bits_agree() and wants_callback() are the conditions of ODE's collideAABBs() other than overlap, read at each report because
// bits and bodies change without notice. Bits come first: they exclude most pairs that always overlap, such as adjacent walls.
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
