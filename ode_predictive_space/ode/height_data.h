// Access to the samples, spacing and scale of a heightfield, for which ODE has no function.

#ifndef ODE_PREDICTIVE_SPACE_ODE_HEIGHT_DATA_H
#define ODE_PREDICTIVE_SPACE_ODE_HEIGHT_DATA_H

#include <ode/collision.h>
#include <ode/contact.h>

#include "ode_predictive_space/surface/height_grid.h"

namespace ode_predictive_space
{
/// ODE's heightfield data, laid out as in ODE 0.16, with unused members.
struct HeightSamples
{
    static constexpr int contacts_per_cell = 10;

    enum Source : int
    {
        callback,
        of_bytes,
        of_shorts,
        of_floats,
        of_doubles
    };

    dReal width, depth; ///< extents of all cells together
    dReal cell_x, cell_z;
    dReal aspect, inverse_x, inverse_z, half_width, half_depth;
    dReal lowest, highest;
    dReal thickness;
    dReal scale, offset; ///< height = sample * scale + offset
    int columns, rows;   ///< numbers of samples
    int owns_samples;
    int repeats;
    int source;
    const void *samples;
    void *user_data; ///< argument of the callback
    dContactGeom contacts[contacts_per_cell];
    dHeightfieldGetHeight *get_height;

    GridSize size() const { return {columns, rows, double{cell_x}, double{cell_z}, repeats != 0}; }
    double sample(int column, int row) const;
    double height(int column, int row) const { return sample(column, row) * double{scale} + double{offset}; }
};

/// The data of a heightfield; null without data, or if the ODE in this process has another layout.
const HeightSamples *height_data_of(dGeomID heightfield);

/// Access to data by their handle, with the same exceptions.
HeightSamples *writable_height_data(dHeightfieldDataID data);
} // namespace ode_predictive_space

#endif
