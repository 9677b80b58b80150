// Small movers on a large ground, among a few huge boxes.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_TERRAIN_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_TERRAIN_SCENE_H

#include "demos/scenes/scene_objects.h"
#include "demos/scenes/terrain_ground.h"

namespace ode_predictive_space::scenes
{
/// Half of the objects roll over the ground, which is a heightfield, a mesh and a plane side by side; the other half fly up
/// to 5 m above it. All move at up to 5 mm per tick and turn back at the edge of a square. Among them are huge boxes, up to
/// 10^4 times as long as an object: still ones (walls, pillars, a roof), two cranes that turn and two airships that drift.
///
/// The motion does not depend on contacts, so it can go on for any time.
class TerrainScene : public Scene
{
public:
    TerrainScene(const SceneSpec &spec, dSpaceID space);

    void advance() override;
    void respond(const std::vector<IndexPair> &) override {}
    std::size_t contacts() const override { return 0; }
    bool moves_by_itself() const override { return true; }
    const std::vector<dGeomID> &geoms() const override { return objects_.geoms(); }
    const ProbeReport *probe() const override { return nullptr; }

private:
    struct Mover
    {
        dBodyID body;
        BodyState state;    ///< kept here too, so that the motion does not depend on how ODE rounds
        Quaternion turn;    ///< per tick
        double rest_height; ///< of the centre of a rolling object above the ground, metres
        bool rolls;
    };

    void add_huge_boxes();
    dGeomID add_huge_still(const Vector3 &size, const Vector3 &position);
    void add_huge_mover(const Vector3 &size, const Vector3 &position, const Vector3 &velocity, double spin);
    void add_mover(int number, haptics::Random &random);
    void advance_mover(Mover &mover) const;
    void roll(Mover &mover) const;
    void turn_back(BodyState &state) const;

    double half_side_;
    TerrainGround ground_; // before the objects, which use it
    SceneObjects objects_;
    std::vector<Mover> movers_;
};

/// The bounds of the small movers, around the middle of the scene.
SceneBounds terrain_bounds(int objects);
} // namespace ode_predictive_space::scenes

#endif
