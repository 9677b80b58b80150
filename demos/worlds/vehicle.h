// Vehicles and robots: a chassis of one or more geoms and four wheels with motors.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_VEHICLE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_VEHICLE_H

#include "demos/worlds/objects.h"
#include "ode_predictive_space/haptics/device/random.h"

namespace ode_predictive_space::worlds
{
/// Lengths in metres.
struct VehicleSize
{
    Vector3 half_chassis{0.3, 0.2, 0.06};
    double wheel_radius = 0.1;
    double mass = 20;   ///< kg, of the chassis
    bool mast = true;   ///< two further geoms of the chassis: a mast and a head on it
    double torque = 10; ///< N m, of each wheel's motor
};

/// Geoms that a vehicle has.
constexpr int geoms_of_vehicle(const VehicleSize &size)
{
    return size.mast ? 7 : 5;
}

/// Make a vehicle whose wheels stand on the height of `place`, and which drives at random speeds.
///
/// @param space of its geoms
/// @param heading radians about the vertical
void add_vehicle(Objects &objects, dSpaceID space, const VehicleSize &size, const Vector3 &place, double heading,
                 haptics::Random &random);
} // namespace ode_predictive_space::worlds

#endif
