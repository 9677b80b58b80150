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
    NoticedGeom(const dxGeom *geom, KnownPoses &known) : geom_(geom), known_(known) {}

    bool has_pose() const { return bounds_follow_from_pose(geom_); }

    /// Of the position and the beginning of the rotation, which are adjacent.
    std::uint32_t pose_digest() const
    {
        const dxPosR *pose = geom_->final_posr;
        return middle_bits_of(pose->pos[0]) + middle_bits_of(pose->pos[1]) + middle_bits_of(pose->pos[2]) +
               middle_bits_of(pose->R[0]);
    }

    bool remember(ProxyId id) const { return known_.remember(id, geom_); }
    bool is_as_remembered(ProxyId id) const { return known_.is_as_remembered(id, geom_); }
    bool is_watched() const { return known_.watches(); }

    /// (The position of a geom with an offset from its body is bad when it has been moved. A geom that has lost its body may
    /// turn by any matrix.)
    bool has_centre() const
    {
        return (geom_->body != nullptr || geom_->type == dSphereClass) && (geom_->gflags & GEOM_POSR_BAD) == 0;
    }
    const dReal *coordinates() const { return geom_->final_posr->pos; }
    bool has_grown(float radius) const { return !(squared_sphere_radius(geom_) <= double{radius} * double{radius}); }

private:
    // Not the lowest bits: numbers that were computed in single precision have none there.
    static std::uint32_t middle_bits_of(const dReal &value)
    {
        constexpr std::size_t first_byte = sizeof value > sizeof(std::uint32_t) ? 3 : 0;
        std::uint32_t bits = 0;
        std::memcpy(&bits, reinterpret_cast<const unsigned char *>(&value) + first_byte, sizeof bits);
        return bits;
    }

    const dxGeom *geom_;
    KnownPoses &known_;
};
} // namespace ode_predictive_space

#endif
