// A geom of ours that the program may destroy with its space.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_GEOM_WATCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_GEOM_WATCH_H

#include <ode/ode.h>

namespace ode_predictive_space::haptics
{
/// ODE does not tell when a space is destroyed with its geoms, but a geom that is destroyed leaves its body. So the geom gets a
/// kinematic body of a world of its own, in which nothing happens.
class GeomWatch
{
public:
    explicit GeomWatch(dGeomID geom) : world_(dWorldCreate()), body_(dBodyCreate(world_))
    {
        dBodySetKinematic(body_);
        dGeomSetBody(geom, body_);
    }

    ~GeomWatch()
    {
        if (world_)
            dWorldDestroy(world_);
    }
    GeomWatch(const GeomWatch &) = delete;
    GeomWatch &operator=(const GeomWatch &) = delete;

    /// Leaves body and world to the geom for good: to destroy them would move the geom, which must not be in a locked space.
    void leave() { world_ = nullptr; }

    bool is_there() const { return dBodyGetFirstGeom(body_) != nullptr; }

private:
    dWorldID world_;
    dBodyID body_;
};
} // namespace ode_predictive_space::haptics

#endif
