// Small movers on a large ground, among a few huge boxes.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_TERRAIN_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_TERRAIN_SCENE_H

#include "demos/scenes/scene_objects.h"
#include "demos/scenes/terrain_ground.h"

namespace ode_predictive_space::scenes
{
/// One of the boxes that are up to 10^4 times as long as an object.
struct HugeBox
{
    Vector3 size;                       ///< metres
    Vector3 position;                   ///< at the start, metres
    Vector3 velocity = Vector3::Zero(); ///< m/s
    double spin = 0;                    ///< about the vertical axis, rad/s

    bool moves() const { return spin != 0 || !velocity.isZero(0); }
};

/// Those of the scene: still ones (walls, pillars, a roof), two cranes that turn and two airships that drift.
///
/// @param half_side of the square in which the objects are, metres
std::vector<HugeBox> huge_boxes(double half_side);

/// The geom of a huge box. It collides with objects, not with the ground or with other huge boxes.
dGeomID make_huge_geom(const HugeBox &box, SceneObjects &objects);

/// Half the side of the square in which so many objects are, metres.
double half_side_of_square(int objects);

/// Height of the centre above the ground for a solid that stands upright on it and touches it, metres.
double rest_height_of(Shape shape);

/// Half of the objects roll over the ground, which is a heightfield, a mesh and a plane side by side; the other half fly up
/// to 5 m above it. All move at up to 5 mm per tick and turn back at the edge of a square. Among them are huge boxes.
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
    void add_huge_mover(const HugeBox &box, dGeomID geom);
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
