#include "demos/haptic/free_place.h"

#include "demos/haptic/room.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace ode_predictive_space::worlds
{
namespace
{
/// Tells whether a sphere at a place touches anything.
class Room
{
public:
    Room(const World &scene, double radius) : sphere_(dCreateSphere(nullptr, radius))
    {
        for (const dGeomID geom : scene.geoms())
        {
            if (geom != nullptr)
                boxes_.emplace_back(bounds_of(geom), geom);
        }
    }
    ~Room() { dGeomDestroy(sphere_); }
    Room(const Room &) = delete;
    Room &operator=(const Room &) = delete;

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
std::optional<Vector3> nearest_on_shell(const Room &room, const Vector3 &middle, double step, int steps,
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
                if (is_nearer && within.contains(place) && room.is_free(place))
                    nearest = place;
            }
        }
    }
    return nearest;
}
} // namespace

std::optional<Vector3> free_place(const World &scene, const Vector3 &wish, double radius, double step,
                                  const Eigen::AlignedBox3d &within)
{
    const Room room(scene, radius);
    if (room.is_free(wish))
        return wish;
    const int most = static_cast<int>(std::ceil(within.sizes().maxCoeff() / step));
    for (int steps = 1; steps <= most; ++steps)
    {
        if (const auto place = nearest_on_shell(room, wish, step, steps, within))
            return place;
    }
    return {};
}
} // namespace ode_predictive_space::worlds
