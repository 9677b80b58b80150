// A geom that turns constantly, and whose position is a polynomial of second degree in ticks.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_TIMES_MOVER_H
#define ODE_PREDICTIVE_SPACE_TESTS_TIMES_MOVER_H

#include <Eigen/Geometry>
#include <ode/ode.h>

#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
enum class Driver
{
    setters, ///< the program, by dGeomSetPosition() and dGeomSetRotation()
    body,    ///< ODE, with the body's velocities and gravity
    kinematic,
    nothing
};

class Mover
{
public:
    /// Places a geom in a space at random, so that it comes near the origin some time later.
    Mover(Random &random, dWorldID world, dSpaceID space, double step);

    /// To be called before the world is stepped.
    void advance();

    void change_motion(Random &random);

    dGeomID geom() const { return geom_; }
    int age() const { return age_; }

private:
    void create_geom(Random &random, dSpaceID space);
    void choose_motion(Random &random);
    void set_pose() const;
    Vector3 travel(double ticks) const;

    double step_; // seconds
    Driver driver_;
    dGeomID geom_ = nullptr;
    dBodyID body_ = nullptr;
    double size_;
    Vector3 begin_ = Vector3::Zero(), velocity_ = Vector3::Zero(), acceleration_ = Vector3::Zero(); // per tick
    Vector3 spin_ = Vector3::Zero();                                                                // per tick
    Eigen::Quaterniond turned_;                                                                     // at the beginning
    int age_ = 0;
};
} // namespace ode_predictive_space

#endif
