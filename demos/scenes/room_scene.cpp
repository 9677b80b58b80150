// Free bodies that fly in a room with rough walls, which is one mesh of many triangles: a scan, or a level of a game.

#include "demos/scenes/flyer.h"
#include "demos/scenes/surface_scenes.h"
#include "demos/scenes/world_scene.h"

#include <array>
#include <vector>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double room_step = 0.001;
constexpr int squares_along_wall = 134; // two triangles each: 215,472 in the room
constexpr double roughness = 0.02;      // metres

double half_side_of_room(int objects)
{
    return 0.45 * std::cbrt(objects) + 0.5;
}

/// ODE keeps pointers into it: it must outlive the geom made of it.
class RoughRoom
{
public:
    RoughRoom(double half, std::uint64_t seed) : half_(half), unevenness_(seed)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            add_wall(axis, -1);
            add_wall(axis, 1);
        }
        dGeomTriMeshDataBuildSingle(data_, vertices_.data(), sizeof(Vertex), static_cast<int>(vertices_.size()),
                                    triangles_.data(), static_cast<int>(3 * triangles_.size()), sizeof(Triangle));
    }
    ~RoughRoom() { dGeomTriMeshDataDestroy(data_); }
    RoughRoom(const RoughRoom &) = delete;
    RoughRoom &operator=(const RoughRoom &) = delete;

    dGeomID make_geom(dSpaceID space) const { return dCreateTriMesh(space, data_, nullptr, nullptr, nullptr); }

private:
    using Vertex = std::array<float, 3>;
    using Triangle = std::array<dTriIndex, 3>;

    void add_wall(int axis, int side)
    {
        const auto first = static_cast<dTriIndex>(vertices_.size());
        constexpr dTriIndex row = squares_along_wall + 1;
        for (int i = 0; i <= squares_along_wall; ++i)
        {
            for (int j = 0; j <= squares_along_wall; ++j)
                add_vertex(axis, side, along(i), along(j));
        }
        for (dTriIndex i = 0; i < squares_along_wall; ++i)
        {
            for (dTriIndex j = 0; j < squares_along_wall; ++j)
            {
                const dTriIndex corner = first + i * row + j;
                add_triangle({corner, corner + row, corner + 1}, side > 0);
                add_triangle({corner + row, corner + row + 1, corner + 1}, side > 0);
            }
        }
    }

    double along(int number) const { return half_ * (2.0 * number / squares_along_wall - 1); }

    void add_vertex(int axis, int side, double one, double other)
    {
        Vector3 place;
        place[axis] = side * (half_ + unevenness_.uniform(0, roughness));
        place[(axis + 1) % 3] = one;
        place[(axis + 2) % 3] = other;
        vertices_.push_back(
            {static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())});
    }

    void add_triangle(const Triangle &corners, bool turned)
    {
        triangles_.push_back(turned ? Triangle{corners[0], corners[2], corners[1]} : corners);
    }

    double half_;
    haptics::Random unevenness_;
    std::vector<Vertex> vertices_;
    std::vector<Triangle> triangles_;
    dTriMeshDataID data_ = dGeomTriMeshDataCreate();
};

class RoomScene : private RoughRoom, public WorldScene
{
public:
    RoomScene(const SceneSpec &spec, dSpaceID space)
        : RoughRoom(half_side_of_room(spec.objects), spec.seed), WorldScene(spec, space, room_step)
    {
        let_fly(objects_.world(), surface_);
        add_scenery(objects_, make_geom(space));
        const Vector3 half = Vector3::Constant(half_side_of_room(spec.objects) - 0.3);
        for (int i = 0; i < spec.objects; ++i)
            add_flyer(objects_, i, {{0.15, 0.15, 0.1}, 0.1}, random_.in_box(half), random_);
    }
};
} // namespace

SceneRecipe room_scene(const SceneSpec &spec)
{
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<RoomScene>(made, space); },
            {Vector3::Zero(), Vector3::Constant(half_side_of_room(spec.objects) + 1)},
            room_step};
}
} // namespace ode_predictive_space::scenes
