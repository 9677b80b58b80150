// What a heightfield is made of: its samples, their distances and scale. ODE has no function that tells.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_HEIGHT_DATA_H
#define ODE_PREDICTIVE_SPACE_SPACE_HEIGHT_DATA_H

#include <ode/collision.h>
#include <ode/contact.h>

#include "ode_predictive_space/surface/height_grid.h"

namespace ode_predictive_space
{
/// ODE's data of a heightfield, in ODE 0.16. Members that are not used here keep their place.
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

    dReal width, depth; ///< of all cells
    dReal cell_x, cell_z;
    dReal aspect, inverse_x, inverse_z, half_width, half_depth;
    dReal lowest, highest;
    dReal thickness;
    dReal scale, offset; ///< a height is a sample times the scale, and the offset
    int columns, rows;   ///< of samples
    int owns_samples;
    int repeats;
    int source;
    const void *samples;
    void *user_data; ///< of the callback
    dContactGeom contacts[contacts_per_cell];
    dHeightfieldGetHeight *get_height;

    GridSize size() const { return {columns, rows, double{cell_x}, double{cell_z}, repeats != 0}; }
    double sample(int column, int row) const;
    double height(int column, int row) const { return sample(column, row) * double{scale} + double{offset}; }
};

/// The data of a heightfield; null when it has none or when the ODE in this process keeps it in another way.
const HeightSamples *height_data_of(dGeomID heightfield);

/// The data themselves, likewise.
HeightSamples *writable_height_data(dHeightfieldDataID data);
} // namespace ode_predictive_space

#endif
