#include "demos/haptic/room.h"

#include <algorithm>

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
} // namespace ode_predictive_space::worlds
