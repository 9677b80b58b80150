#include "demos/worlds/heightfield.h"

namespace ode_predictive_space::worlds
{
// ODE's heightfields have y upwards; turned upright by a quarter about x, their z runs against our y.
Heightfield::Heightfield(double width, double depth, int columns, int rows,
                         const std::function<double(int, int)> &height, double thickness)
    : data_(dGeomHeightfieldDataCreate())
{
    for (int row = 0; row < rows; ++row)
    {
        for (int column = 0; column < columns; ++column)
            heights_.push_back(height(column, row));
    }
    dGeomHeightfieldDataBuildDouble(data_, heights_.data(), 0, width, depth, columns, rows, 1, 0, thickness, 0);
}

Heightfield::Heightfield(double half, int samples, double (*height)(double, double), double highest)
    : Heightfield(
          2 * half, 2 * half, samples, samples,
          [=](int column, int row) {
              return height(half * (2.0 * column / (samples - 1) - 1), -half * (2.0 * row / (samples - 1) - 1));
          },
          1)
{
    dGeomHeightfieldDataSetBounds(data_, -highest, highest);
}

dGeomID Heightfield::make_geom(dSpaceID space) const
{
    const dGeomID geom = dCreateHeightfield(space, data_, 1);
    set_orientation(geom, Quaternion(Eigen::AngleAxisd(pi / 2, Vector3::UnitX())));
    return geom;
}
} // namespace ode_predictive_space::worlds
