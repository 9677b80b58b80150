#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_GEOM_READER_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_GEOM_READER_H

#include "demos/window/view.h"
#include "demos/worlds/world.h"

#include <Eigen/Geometry>
#include <map>
#include <ode/ode.h>

namespace ode_predictive_space::demo
{
inline std::uintptr_t id_of(dGeomID geom)
{
    return reinterpret_cast<std::uintptr_t>(geom);
}

/// Reads a few geoms at a time, so that a loop at 1 kHz has little work in each tick. For the thread that steps the world.
class GeomReader
{
public:
    /// @param room geoms larger than half of it are walls.
    GeomReader(const worlds::World &scene, const Eigen::AlignedBox3d &room);

    /// @param most the largest number of geoms to read. @param geoms receives them; it is cleared when a new round begins.
    /// @return whether all geoms have been read: geoms is complete, and the next call starts a new round.
    bool read(std::size_t most, std::vector<window::DrawnGeom> &geoms);

private:
    window::DrawnGeom drawn(dGeomID geom);
    std::shared_ptr<const window::Triangles> triangles_of(dGeomID mesh);
    bool is_wall(dGeomID geom) const;

    const worlds::World &scene_;
    double wall_size_; ///< m
    std::size_t next_ = 0;
    std::map<dTriMeshDataID, std::shared_ptr<const window::Triangles>> meshes_;
    std::map<dGeomID, std::shared_ptr<const window::Triangles>> hills_; ///< in the scene's frame
};
} // namespace ode_predictive_space::demo

#endif
