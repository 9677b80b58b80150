// The paper's experiment: still and moving objects in a room, and a probe that a hand moves among them.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_MIX_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_MIX_SCENE_H

#include "demos/scenes/contact_scene.h"
#include "demos/scenes/probe_force.h"
#include "ode_predictive_space/haptics/device/random.h"
#include "ode_predictive_space/haptics/hand_path.h"

namespace ode_predictive_space::scenes
{
/// Half the side of the room inside its walls, in metres.
double mix_half_room(int objects);

/// Spheres, boxes, capsules and meshes in equal parts, without gravity. Half of them have no body and stay; the others float
/// through the room, bounce off one another and off the walls, and are gently driven back to their initial speed, so that the
/// motion does not die down. The probe, unless the caller brings one, is the geom number 0: a sphere without a body, placed at
/// the hand.
class MixScene : public ContactScene
{
public:
    MixScene(const SceneSpec &spec, dSpaceID space);

    void advance() override;
    void respond(const std::vector<IndexPair> &pairs) override;
    const ProbeReport *probe() const override { return probe_ != nullptr ? &report_ : nullptr; }

private:
    struct Floater
    {
        dBodyID body;
        double cruising_speed; ///< m/s
        double mass;           ///< kg
    };

    void fill(int count, haptics::Random &random);
    void add_floater(Shape shape, const Vector3 &position, haptics::Random &random);
    void before_step() override;
    bool take_contacts(const IndexPair &pair, const dContactGeom *contacts, int count) override;

    haptics::HandPath hand_;
    dGeomID probe_; ///< null when the caller brings one
    ProbeForce force_;
    ProbeReport report_;
    std::vector<Floater> floaters_;
    int tick_ = 0;
};
} // namespace ode_predictive_space::scenes

#endif
