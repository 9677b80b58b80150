#include "ode_predictive_space/space/height_data.h"

#include <limits>

namespace ode_predictive_space
{
namespace
{
const HeightSamples *laid_out(dHeightfieldDataID data)
{
    return reinterpret_cast<const HeightSamples *>(data);
}

dReal known_height(void *, int column, int)
{
    return static_cast<dReal>(column);
}

// Data with a value of its own in every member that is read.
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

bool knows_heightfields()
{
    static const bool known = heightfields_are_as_expected();
    return known;
}

template <typename T> double sample(const void *samples, int index)
{
    return static_cast<double>(static_cast<const T *>(samples)[index]);
}
} // namespace

double HeightSamples::height(int column, int row) const
{
    const auto scaled = [this](double value) { return value * double{scale} + double{offset}; };
    const int index = column + row * columns;
    switch (source)
    {
    case callback:
        return scaled(get_height(user_data, column, row));
    case of_bytes:
        return scaled(sample<unsigned char>(samples, index));
    case of_shorts:
        return scaled(sample<short>(samples, index));
    case of_floats:
        return scaled(sample<float>(samples, index));
    case of_doubles:
        return scaled(sample<double>(samples, index));
    default:
        return std::numeric_limits<double>::quiet_NaN();
    }
}

const HeightSamples *height_data_of(dGeomID heightfield)
{
    return knows_heightfields() ? laid_out(dGeomHeightfieldGetHeightfieldData(heightfield)) : nullptr;
}
} // namespace ode_predictive_space
