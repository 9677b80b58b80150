#include "demos/haptic/room.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace ode_predictive_space::worlds
{
Eigen::AlignedBox3d bounds_of(dGeomID geom)
{
    dReal box[6];
    dGeomGetAABB(geom, box);
    return {Vector3(box[0], box[2], box[4]), Vector3(box[1], box[3], box[5])};
}

Eigen::AlignedBox3d room_inside_walls(const World &scene, const Bounds &bounds)
{
    Eigen::AlignedBox3d room(bounds.centre - bounds.half_extent, bounds.centre + bounds.half_extent);
    for (const dGeomID geom : scene.geoms())
    {
        if (geom == nullptr)
            continue;
        const Eigen::AlignedBox3d box = bounds_of(geom);
        if (dGeomGetBody(geom) != nullptr || box.sizes().maxCoeff() < bounds.half_extent.minCoeff())
            continue;
        if (dGeomGetClass(geom) == dTriMeshClass && box.contains(bounds.centre))
            room = room.intersection(box); // it is within the mesh
        if (dGeomGetClass(geom) == dHeightfieldClass)
            room.min().z() = std::max(room.min().z(), box.min().z());
        if (dGeomGetClass(geom) != dBoxClass)
            continue;
        for (int axis = 0; axis < 3; ++axis)
        {
            if (box.min()[axis] > bounds.centre[axis])
                room.max()[axis] = std::min(room.max()[axis], box.min()[axis]);
            if (box.max()[axis] < bounds.centre[axis])
                room.min()[axis] = std::max(room.min()[axis], box.max()[axis]);
        }
    }
    return room;
}

namespace
{
class Obstacles
{
public:
    Obstacles(const World &scene, double radius) : sphere_(dCreateSphere(nullptr, radius))
    {
        for (const dGeomID geom : scene.geoms())
        {
            if (geom != nullptr)
                boxes_.emplace_back(bounds_of(geom), geom);
        }
    }
    ~Obstacles() { dGeomDestroy(sphere_); }
    Obstacles(const Obstacles &) = delete;
    Obstacles &operator=(const Obstacles &) = delete;

    bool is_free(const Vector3 &place) const
    {
        set_position(sphere_, place);
        const Eigen::AlignedBox3d around = bounds_of(sphere_);
        dContactGeom contact;
        return std::none_of(boxes_.begin(), boxes_.end(), [&](const auto &other) {
            return around.intersects(other.first) && dCollide(sphere_, other.second, 1, &contact, sizeof contact) > 0;
        });
    }

private:
    dGeomID sphere_;
    std::vector<std::pair<Eigen::AlignedBox3d, dGeomID>> boxes_;
};

/// A free place in the room near the wish: places are drawn further and further away, and the first that is free is taken.
std::optional<Vector3> place_near(const World &scene, const Vector3 &wish, double radius,
                                  const Eigen::AlignedBox3d &room)
{
    constexpr int attempts = 20000;
    const Obstacles obstacles(scene, radius);
    haptics::Random random(1);
    for (int i = 0; i < attempts; ++i)
    {
        const Vector3 place = wish + i * (room.diagonal().norm() / attempts) * random.direction();
        if ((i == 0 || room.contains(place)) && obstacles.is_free(place))
            return place;
    }
    return {};
}
} // namespace

Vector3 free_place(const World &scene, const Vector3 &wish, double radius, const Eigen::AlignedBox3d &room)
{
    if (const auto place = place_near(scene, wish, 1.5 * radius, room))
        return *place;
    const Vector3 beyond = Vector3::Constant(2 * radius);
    return place_near(scene, wish, radius, {room.min() - beyond, room.max() + beyond}).value_or(wish);
}
} // namespace ode_predictive_space::worlds
