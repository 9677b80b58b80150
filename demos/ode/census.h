#ifndef ODE_PREDICTIVE_SPACE_DEMOS_ODE_CENSUS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_ODE_CENSUS_H

#include <Eigen/Geometry>
#include <ode/ode.h>

namespace ode_predictive_space::ode_demos
{
/// Geoms in nested spaces count, the spaces do not. Bodies count if they have a geom in the space.
struct Census
{
    int geoms = 0;
    int bodies = 0;
    int resting = 0;             ///< bodies that are disabled
    int contacts = 0;            ///< contact joints at the bodies
    bool finite = true;          ///< position, rotation and velocities of all bodies
    double mean_height = 0;      ///< of the bodies; 0 without any
    Eigen::AlignedBox3d centres; ///< of the bodies; empty without any
};

/// The census is empty in ODE's quadtree, which cannot list its geoms.
Census take_census(dSpaceID space);
} // namespace ode_predictive_space::ode_demos

#endif
