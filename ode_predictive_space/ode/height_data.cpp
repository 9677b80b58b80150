#include "ode_predictive_space/ode/height_data.h"

#include <limits>

namespace ode_predictive_space
{
namespace
{
HeightSamples *laid_out(dHeightfieldDataID data)
{
    return reinterpret_cast<HeightSamples *>(data);
}

dReal known_height(void *, int column, int)
{
    return static_cast<dReal>(column);
}

// Builds data with a distinct value in every member that is read.
bool heightfields_are_as_expected()
{
    constexpr int columns = 3, rows = 5;
    int user_data = 0;
    const dHeightfieldDataID data = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildCallback(data, &user_data, &known_height, 14, 44, columns, rows, 2, 3, 4, 1);
    const HeightSamples &found = *laid_out(data);
    const bool callback_as_expected =
        found.width == 14 && found.depth == 44 && found.cell_x == 7 && found.cell_z == 11 && found.thickness == 4 &&
        found.scale == 2 && found.offset == 3 && found.columns == columns && found.rows == rows && found.repeats == 1 &&
        found.source == HeightSamples::callback && found.user_data == &user_data && found.get_height == &known_height;
    constexpr float samples[] = {1, 2, 3, 4};
    dGeomHeightfieldDataBuildSingle(data, samples, 0, 1, 1, 2, 2, 1, 0, 1, 0);
    const bool samples_as_expected = found.source == HeightSamples::of_floats && found.samples == samples &&
                                     found.owns_samples == 0 && found.repeats == 0;
    dGeomHeightfieldDataDestroy(data);
    return callback_as_expected && samples_as_expected;
}

template <typename T> double element(const void *samples, int index)
{
    return static_cast<double>(static_cast<const T *>(samples)[index]);
}
} // namespace

double HeightSamples::sample(int column, int row) const
{
    const int index = column + row * columns;
    switch (source)
    {
    case callback:
        return get_height(user_data, column, row);
    case of_bytes:
        return element<unsigned char>(samples, index);
    case of_shorts:
        return element<short>(samples, index);
    case of_floats:
        return element<float>(samples, index);
    case of_doubles:
        return element<double>(samples, index);
    default:
        return std::numeric_limits<double>::quiet_NaN();
    }
}

HeightSamples *writable_height_data(dHeightfieldDataID data)
{
    static const bool known = heightfields_are_as_expected();
    return known ? laid_out(data) : nullptr;
}

const HeightSamples *height_data_of(dGeomID heightfield)
{
    return writable_height_data(dGeomHeightfieldGetHeightfieldData(heightfield));
}
} // namespace ode_predictive_space
