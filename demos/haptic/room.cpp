#include "demos/haptic/room.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

/// The nearest free place on the surface of a cube of lattice points, so many steps from its middle.
std::optional<Vector3> nearest_on_shell(const Obstacles &obstacles, const Vector3 &middle, double step, int steps,
                                        const Eigen::AlignedBox3d &within)
{
    std::optional<Vector3> nearest;
    for (int x = -steps; x <= steps; ++x)
    {
        for (int y = -steps; y <= steps; ++y)
        {
            const bool is_side = std::max(std::abs(x), std::abs(y)) == steps;
            for (int z = -steps; z <= steps; z += is_side ? 1 : 2 * steps)
            {
                const Vector3 place = middle + step * Vector3(x, y, z);
                const bool is_nearer = !nearest || (place - middle).norm() < (*nearest - middle).norm();
                if (is_nearer && within.contains(place) && obstacles.is_free(place))
                    nearest = place;
            }
        }
    }
    return nearest;
}
/// @param step m; of the lattice. @param within m; the place is in this box. @return nothing when there is no such place.
std::optional<Vector3> nearest_free(const World &scene, const Vector3 &wish, double radius, double step,
                                    const Eigen::AlignedBox3d &within)
{
    const Obstacles obstacles(scene, radius);
    if (obstacles.is_free(wish))
        return wish;
    const int most = static_cast<int>(std::ceil(within.sizes().maxCoeff() / step));
    for (int steps = 1; steps <= most; ++steps)
    {
        if (const auto place = nearest_on_shell(obstacles, wish, step, steps, within))
            return place;
    }
    return {};
}
} // namespace

Vector3 free_place(const World &scene, const Vector3 &wish, double radius, const Eigen::AlignedBox3d &room)
{
    if (const auto place = nearest_free(scene, wish, 1.5 * radius, radius, room))
        return *place;
    const Vector3 beyond = Vector3::Constant(2 * radius);
    return nearest_free(scene, wish, radius, radius / 4, {room.min() - beyond, room.max() + beyond}).value_or(wish);
}
} // namespace ode_predictive_space::worlds
