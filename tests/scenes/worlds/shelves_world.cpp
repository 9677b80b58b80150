// A store: still boxes on shelves, and fifty robots in the aisles. The ground is a plane, or ground and walls are one mesh.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/box_mesh.h"
#include "tests/scenes/worlds/makers.h"
#include "tests/scenes/worlds/vehicle.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double shelves_step = 0.005;
constexpr int robots = 50;
constexpr int levels = 5;             // of a shelf
constexpr double place_width = 0.5;   // of a box in its shelf, metres
constexpr double level_height = 0.45; // metres
constexpr double aisle = 2.5;         // from shelf to shelf, metres
constexpr double height = 5;          // of the room, metres

/// Places along a shelf and shelves, so that the store is about square.
int places(int boxes)
{
    return std::max(4, static_cast<int>(std::sqrt(boxes / levels * aisle / place_width)));
}

double half_side_of_shelves(int boxes)
{
    return 0.5 * place_width * places(boxes) + 2 * aisle;
}

/// Before the scene, whose geoms point into it.
struct Building
{
    BoxMesh mesh;
};

class ShelvesWorld : private Building, public WorldScene
{
public:
    ShelvesWorld(const SceneSpec &spec, dSpaceID space, bool one_mesh) : WorldScene(spec, space, shelves_step)
    {
        const double half = half_side_of_shelves(spec.objects);
        add_ground(half, one_mesh);
        for (int i = 0; i < spec.objects; ++i)
        {
            const int column = i / levels;
            const Vector3 place(place_width * (column % places(spec.objects) + 0.5) - half + 2 * aisle,
                                aisle * (column / places(spec.objects)) - half + 2 * aisle,
                                0.3 + level_height * (i % levels));
            set_position(add_scenery(objects_, dCreateBox(space, 0.4, 0.35, 0.3)), place);
        }
        const int per_row = 10;
        for (int i = 0; i < robots; ++i)
        {
            const Vector3 place((i % per_row + 0.5) * 2 * (half - aisle) / per_row - half + aisle,
                                aisle * (i / per_row + 0.5) - half + aisle, 0);
            add_vehicle(objects_, space, {}, place, i % 2 == 0 ? 0 : pi, random_);
        }
    }

private:
    void add_ground(double half, bool one_mesh)
    {
        if (one_mesh)
        {
            mesh.add_room({half, half, height}, false);
            const dGeomID geom = add_scenery(objects_, mesh.make_geom(objects_.space()));
            set_position(geom, {0, 0, height});
            return;
        }
        add_scenery(objects_, dCreatePlane(objects_.space(), 0, 0, 1, 0));
    }
};
} // namespace

SceneRecipe shelves_world(const SceneSpec &spec, bool one_mesh)
{
    const double half = half_side_of_shelves(spec.objects) + 1;
    return {[one_mesh](const SceneSpec &made, dSpaceID space) {
                return std::make_unique<ShelvesWorld>(made, space, one_mesh);
            },
            {{0, 0, height / 2}, {half, half, height}},
            shelves_step};
}
} // namespace ode_predictive_space::scenes
