// Enumeration of the bodies of worlds, and checks for numbers that are not finite.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_BODIES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_BODIES_H

#include "ode_predictive_space/haptics/contact/scene_geoms.h"

#include <memory>
#include <ode/common.h>
#include <string>
#include <vector>

namespace ode_predictive_space::haptics
{
/// A sentence that names the body and a part of its state, force or torque that is not finite; empty when all is finite.
/// ODE ends the program by an assertion for it, or spreads it to other bodies.
std::string broken_state_of(dBodyID body);

/// The newest body of a world; next_body_of_world() leads to the others. ODE has no function for that.
/// @throws std::runtime_error when the layout differs from that of ODE 0.15 to 0.16.6.
dBodyID first_body_of(dWorldID world);

dBodyID next_body_of_world(dBodyID body);

/// All bodies of the worlds of a scene (see HapticLoop). Worlds are searched by geoms at first, when a world was
/// destroyed, and when the number of geoms changes while no world is known.
class SceneBodies
{
public:
    /// @param geom the probe's or the tool's; may be 0.
    explicit SceneBodies(dGeomID geom) { find_worlds(outermost_space_of(geom)); }

    std::string broken_state(dBodyID tool, dGeomID geom);

private:
    struct DestroyMark
    {
        void operator()(dGeomID geom) const;
    };

    /// ODE does not report that a world is destroyed, but it detaches the bodies from their geoms. So each world gets a
    /// disabled body with this geom, which is in no space.
    using Mark = std::unique_ptr<dxGeom, DestroyMark>;

    void find_worlds(dSpaceID scene);
    void add_world_of(dBodyID body);
    static dWorldID world_of(const Mark &mark);

    std::vector<Mark> worlds_;
    int searched_ = 0; ///< number of geoms of the outermost space
};
} // namespace ode_predictive_space::haptics

#endif
