#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BOXES_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BOXES_H

#include "ode_predictive_space/broadphase/base/float_box.h"
#include "ode_predictive_space/ode/internals.h"

namespace ode_predictive_space::benchmarks
{
/// The geom's bounding box, rounded outwards. It must be up to date.
inline FloatBox float_box_of(const dxGeom *geom)
{
    const dReal *aabb = geom->aabb;
    Box box;
    box.min() = {aabb[0], aabb[2], aabb[4]};
    box.max() = {aabb[1], aabb[3], aabb[5]};
    return FloatBox::around(box);
}
} // namespace ode_predictive_space::benchmarks

#endif
