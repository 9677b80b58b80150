#include "demos/scenes/hills.h"

#include "demos/scenes/world_scene.h"

namespace ode_predictive_space::scenes
{
Hills::Hills(double half, int samples, HeightFunction height, double highest) : data_(dGeomHeightfieldDataCreate())
{
    for (int row = 0; row < samples; ++row)
    {
        for (int column = 0; column < samples; ++column)
        {
            // The heightfield's z is our -y.
            const double x = half * (2.0 * column / (samples - 1) - 1);
            const double y = -half * (2.0 * row / (samples - 1) - 1);
            heights_.push_back(height(x, y));
        }
    }
    dGeomHeightfieldDataBuildDouble(data_, heights_.data(), 0, 2 * half, 2 * half, samples, samples, 1, 0, 1, 0);
    dGeomHeightfieldDataSetBounds(data_, -highest, highest);
}

Hills::~Hills()
{
    dGeomHeightfieldDataDestroy(data_);
}

void Hills::add_to(SceneObjects &objects) const
{
    set_orientation(add_scenery(objects, dCreateHeightfield(objects.space(), data_, 1)),
                    Quaternion(Eigen::AngleAxisd(pi / 2, Vector3::UnitX())));
}
} // namespace ode_predictive_space::scenes
