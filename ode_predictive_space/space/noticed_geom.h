// A geom whose move is being reported, as the broad phase reads it. It has just been written and lies in the cache.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_NOTICED_GEOM_H
#define ODE_PREDICTIVE_SPACE_SPACE_NOTICED_GEOM_H

#include <cstring>

#include "ode_predictive_space/space/geom_scene.h"
#include "ode_predictive_space/space/known_poses.h"

namespace ode_predictive_space
{
/// The object that Verifier::report_move() asks.
class NoticedGeom
{
public:
    NoticedGeom(ProxyId id, const dxGeom *geom, KnownPoses &known) : id_(id), geom_(geom), known_(known) {}

    bool has_pose() const { return bounds_follow_from_pose(geom_); }

    /// Of the position and the beginning of the rotation, which are adjacent.
    std::uint32_t pose_digest() const
    {
        const dxPosR *pose = geom_->final_posr;
        return middle_bits_of(pose->pos[0]) + middle_bits_of(pose->pos[1]) + middle_bits_of(pose->pos[2]) +
               middle_bits_of(pose->R[0]);
    }

    bool remember() const { return known_.remember(id_, geom_); }
    bool is_as_remembered() const { return known_.is_as_remembered(id_, geom_); }

    /// A geom without a body, or one that has lost it, may turn by any matrix.
    bool has_centre() const { return geom_->body != nullptr || geom_->type == dSphereClass; }
    const dReal *coordinates() const { return geom_->final_posr->pos; }
    bool has_grown(float radius) const { return !(squared_sphere_radius(geom_) <= double{radius} * double{radius}); }

private:
    // Numbers that were computed in single precision have no lower bits.
    static std::uint32_t middle_bits_of(dReal value)
    {
        constexpr unsigned dropped = sizeof value == sizeof(std::uint64_t) ? 24 : 0;
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof value);
        return static_cast<std::uint32_t>(bits >> dropped);
    }

    ProxyId id_;
    const dxGeom *geom_;
    KnownPoses &known_;
};
} // namespace ode_predictive_space

#endif
