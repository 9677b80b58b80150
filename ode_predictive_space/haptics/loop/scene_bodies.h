// The bodies of a scene: all of a world, and those that ODE must not step.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_BODIES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_BODIES_H

#include "ode_predictive_space/haptics/contact/scene_geoms.h"

#include <memory>
#include <ode/common.h>
#include <string>
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

/// All bodies of the worlds of a scene, which HapticLoop tells of. The geoms are searched for such worlds at first, when a world was
/// destroyed, and when their number changes while no world is known.
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
    struct DestroyMark
    {
        void operator()(dGeomID geom) const;
    };

    /// ODE does not tell when a world is destroyed, but it takes its bodies off their geoms. So a world gets a body, disabled and
    /// without joints, which is never stepped, and the body this geom, which is in no space.
    using Mark = std::unique_ptr<dxGeom, DestroyMark>;

    void find_worlds(dSpaceID scene);
    void add_world_of(dBodyID body);
    static dWorldID world_of(const Mark &mark);

    std::vector<Mark> worlds_;
    int searched_ = 0; ///< how many geoms there were in the outermost space
};
} // namespace ode_predictive_space::haptics

#endif
