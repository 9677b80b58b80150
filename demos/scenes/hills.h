// Ground that is a heightfield.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_HILLS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_HILLS_H

#include "demos/scenes/scene_objects.h"

#include <vector>

namespace ode_predictive_space::scenes
{
/// In: x and y. Out: the height. Metres.
using HeightFunction = double (*)(double, double);

/// ODE keeps pointers into the heights: they must outlive the geom made of them.
class Hills
{
public:
    /// @param half half a side of the ground, metres
    /// @param samples along each side
    /// @param highest bounds of the heights above and below 0
    Hills(double half, int samples, HeightFunction height, double highest);
    ~Hills();
    Hills(const Hills &) = delete;
    Hills &operator=(const Hills &) = delete;

    /// Scenery; z is up.
    void add_to(SceneObjects &objects) const;

private:
    std::vector<double> heights_;
    dHeightfieldDataID data_;
};
} // namespace ode_predictive_space::scenes

#endif
