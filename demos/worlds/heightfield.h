// Ground that is a heightfield.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_HEIGHTFIELD_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_HEIGHTFIELD_H

#include "demos/worlds/objects.h"

#include <functional>
#include <vector>

namespace ode_predictive_space::worlds
{
/// ODE keeps pointers into the heights: they must outlive the geom made of them.
class Heightfield
{
public:
    /// @param width along x, metres
    /// @param depth along y, metres
    /// @param height of the sample in this column, along x, and row, against y, metres
    /// @param thickness below the lowest height, metres
    Heightfield(double width, double depth, int columns, int rows, const std::function<double(int, int)> &height,
                double thickness);

    /// A square around the middle, with the height of each place, at most `highest` above or below 0.
    Heightfield(double half, int samples, double (*height)(double, double), double highest);

    ~Heightfield() { dGeomHeightfieldDataDestroy(data_); }
    Heightfield(const Heightfield &) = delete;
    Heightfield &operator=(const Heightfield &) = delete;

    /// z is up.
    dGeomID make_geom(dSpaceID space) const;

private:
    std::vector<double> heights_;
    dHeightfieldDataID data_;
};
} // namespace ode_predictive_space::worlds

#endif
