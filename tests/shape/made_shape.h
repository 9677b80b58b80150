#ifndef ODE_PREDICTIVE_SPACE_TESTS_SHAPE_MADE_SHAPE_H
#define ODE_PREDICTIVE_SPACE_TESTS_SHAPE_MADE_SHAPE_H

#include "ode_predictive_space/space/geom_shape.h"

namespace ode_predictive_space
{
inline ConvexShape made_shape(dGeomID geom)
{
    HullStore hulls;
    std::size_t steps = HullMaker::all_steps;
    ConvexShape shape;
    follow_geom(0, geom, hulls, steps, shape);
    return shape;
}
} // namespace ode_predictive_space

#endif
