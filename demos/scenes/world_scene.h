// What scenes share that are like programs' own: gravity, soft contacts, steps that may vary, bodies, spaces in the space.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_WORLD_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_WORLD_SCENE_H

#include "demos/scenes/contact_scene.h"

#include <vector>

namespace ode_predictive_space::scenes
{
/// Give a geom a new body of this mass, in kg, with the inertia of the geom's box.
dBodyID add_body(SceneObjects &objects, dGeomID geom, double mass, const BodyState &state);

/// A further geom of a body, at a place relative to it.
void attach(SceneObjects &objects, dGeomID geom, dBodyID body, const Vector3 &offset);

/// A geom without a body that does not collide with others of its kind: ground, shelves, trees.
dGeomID add_scenery(SceneObjects &objects, dGeomID geom);

/// Set the speed of a hinge, in rad/s, and the largest torque for it, in N m.
void drive(dJointID hinge, double speed, double torque);

/// A world as a program has it: contacts between all bodies that no joint connects.
class WorldScene : public ContactScene
{
public:
    void advance() override;

protected:
    WorldScene(const SceneSpec &spec, dSpaceID space, double step_seconds);
    ~WorldScene() override;

    /// Let each step be longer or shorter by up to this share.
    void vary_steps(double share) { variation_ = share; }

    /// A space of the scene's kind, in the scene's space.
    dSpaceID add_space(const SceneBounds &bounds);

    bool take_contacts(const IndexPair &pair, const dContactGeom *contacts, int count) override;

    /// Seconds of the present step.
    double step() const { return step_; }

    haptics::Random random_;

private:
    double mean_step_;
    double step_;
    double variation_ = 0;
    haptics::Random step_random_;
    std::vector<dSpaceID> spaces_;
};

/// A space of the same kind and with the same settings as another one, in `parent` or, when that is null, by itself.
dSpaceID make_space_like(dSpaceID model, dSpaceID parent, const SceneBounds &bounds);
} // namespace ode_predictive_space::scenes

#endif
