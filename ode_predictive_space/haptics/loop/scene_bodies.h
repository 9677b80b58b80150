// The bodies of a scene: all of a world, and those that ODE must not step.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_BODIES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_BODIES_H

#include "ode_predictive_space/haptics/contact/scene_geoms.h"

#include <ode/common.h>
#include <string>
#include <utility>
#include <vector>

namespace ode_predictive_space::haptics
{
/// What of a body's state is not finite, its force and torque included: dWorldStep() and dSpaceCollide() end the program for it by
/// an assertion, or spread it to other bodies.
///
/// @param body may be 0.
/// @return a sentence that names the body; empty when all is finite.
std::string broken_state_of(dBodyID body);

/// The body of a world that was made last: from it, next_body_of_world() leads to all others, which ODE has no function to find.
///
/// @return 0 when the world has none.
/// @throws std::runtime_error when the ODE in this process keeps its bodies in another way than 0.15 to 0.16.6.
dBodyID first_body_of(dWorldID world);

/// @return 0 after the last one.
dBodyID next_body_of_world(dBodyID body);

/// A world that may be destroyed at any time.
///
/// ODE does not tell when a world is destroyed, but it takes its bodies off their geoms. So the world gets a body, disabled and without
/// joints, which is never stepped, and the body a geom that is in no space.
class WatchedWorld
{
public:
    explicit WatchedWorld(dWorldID world);
    ~WatchedWorld();
    WatchedWorld(WatchedWorld &&other) noexcept : geom_(std::exchange(other.geom_, nullptr)) {}
    WatchedWorld &operator=(WatchedWorld &&other) noexcept
    {
        std::swap(geom_, other.geom_);
        return *this;
    }

    /// @return 0 when it was destroyed.
    dWorldID world() const;

private:
    dGeomID geom_;
};

/// All bodies of the worlds of a scene: of those that have a body with a geom in the spaces around the probe's and within those, except
/// in ODE's quadtrees.
///
/// The geoms are searched for such worlds at first, when a world was destroyed, and when their number changes while no world is known.
class SceneBodies
{
public:
    /// @param geom the probe's or the tool's; may be 0.
    explicit SceneBodies(dGeomID geom) { find_worlds(outermost_space_of(geom)); }

    /// A look at all bodies, also of the tool's world.
    ///
    /// @param tool may be 0. @param geom as the constructor's.
    /// @return broken_state_of() the first body of which something is not finite; else empty.
    std::string broken_state(dBodyID tool, dGeomID geom);

private:
    void find_worlds(dSpaceID scene);
    void add_world_of(dBodyID body);
    bool forget_destroyed();

    std::vector<WatchedWorld> worlds_;
    int searched_ = 0; ///< how many geoms there were in the outermost space
};
} // namespace ode_predictive_space::haptics

#endif
