// Poses that programs set again and again although they do not change.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_KNOWN_POSES_H
#define ODE_PREDICTIVE_SPACE_SPACE_KNOWN_POSES_H

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "ode_predictive_space/broadphase/base/ids.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/space/geom_scene.h"

namespace ode_predictive_space
{
/// Does the bounding box of the geom follow from its pose and its sizes alone? This holds for spheres, boxes, capsules and
/// cylinders. The data of other classes may change without a sign in the geom.
inline bool bounds_follow_from_pose(const dxGeom *geom)
{
    static_assert(dSphereClass == 0 && dBoxClass == 1 && dCapsuleClass == 2 && dCylinderClass == 3,
                  "the four classes come first");
    return static_cast<unsigned>(geom->type) <= dCylinderClass && (geom->gflags & GEOM_POSR_BAD) == 0;
}

/// Pose and sizes of geoms of these classes, by number, as they were when a notice found them for the second time. Takes memory
/// in programs that set poses again, and in no others.
///
/// To compare poses takes as long as half a notice. So all are compared for the first ticks of every 64, and for the others only
/// if a pose was set again in these.
class KnownPoses
{
public:
    /// Is it worth while to compare poses now?
    bool watches() const { return watches_; }

    void end_tick()
    {
        constexpr unsigned trial = 4, period = 64;
        ++ticks_;
        if (ticks_ % period == 0)
            found_ = false;
        watches_ = found_ || ticks_ % period < trial;
    }

    /// Keeps pose and sizes, if there is room for them; otherwise there will be from the next make_room() on.
    bool remember(ProxyId id, const dxGeom *geom)
    {
        found_ = watches_ = wanted_ = true;
        if (id >= poses_.size())
            return false;
        poses_[id] = of(geom);
        return true;
    }

    /// A pose was found to be set again.
    void note_repetition() { found_ = watches_ = true; }

    /// Are pose and sizes, to the bit, those that were remembered?
    bool is_as_remembered(ProxyId id, const dxGeom *geom) const
    {
        const Known now = of(geom);
        return std::memcmp(&poses_[id], &now, sizeof now) == 0;
    }

    /// Was any pose set again, and is there no room for it among `count` geoms?
    bool needs_room(std::size_t count) const { return wanted_ && poses_.size() != count; }

    /// Makes room for geoms 0 to count - 1, if it is needed.
    void make_room(std::size_t count)
    {
        if (needs_room(count))
            resize_array(poses_, count);
    }

    std::size_t bytes() const { return bytes_of(poses_); }

private:
    struct Known
    {
        dReal position[3];
        dReal rotation[9];
        dReal sizes[3];
    };
    static_assert(sizeof(Known) == 15 * sizeof(dReal), "no padding: it is compared as memory");

    static Known of(const dxGeom *geom)
    {
        constexpr std::array<std::size_t, 4> sizes_of_class{1, 3, 2, 2};
        constexpr int rows = 3, row_stride = 4;
        const dxPosR *pose = geom->final_posr;
        Known known{};
        std::copy_n(pose->pos, 3, known.position);
        for (int row = 0; row < rows; ++row)
            std::copy_n(pose->R + row_stride * row, rows, known.rotation + rows * row);
        std::copy_n(sizes_of(geom), sizes_of_class[static_cast<std::size_t>(geom->type)], known.sizes);
        return known;
    }

    std::vector<Known> poses_;
    bool wanted_ = false; // some pose was set again, ever
    bool found_ = false;  // the same in these 64 ticks
    bool watches_ = true;
    unsigned ticks_ = 0;
};
} // namespace ode_predictive_space

#endif
