// A geom at the moment of its notice, when ODE has just written it and it is in the cache.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_NOTICED_GEOM_H
#define ODE_PREDICTIVE_SPACE_SPACE_NOTICED_GEOM_H

#include <algorithm>
#include <cmath>

#include "ode_predictive_space/space/geom_scene.h"
#include "ode_predictive_space/space/rotation.h"

namespace ode_predictive_space
{
/// Largest coordinate of an offset at which a geom is followed.
constexpr float most_offset = 1e15f;

/// A geom with an offset from its body. ODE computes its pose only on demand.
class CarriedGeom
{
public:
    explicit CarriedGeom(const dxGeom *geom)
        : geom_(geom), body_(reinterpret_cast<const dxPosR *>(dBodyGetPosition(geom->body))), rotation_(body_->R),
          offset_(Float4::nearest_of_stored(geom->offset_posr->pos, 1))
    {}

    /// Does the sphere of carried() still hold the geom? The matrices or the offset may have changed.
    /// @param allowed_offset largest coordinate of an offset that the radius allows for.
    bool turns_safely(float allowed_offset) const
    {
        const dMatrix3 &turned = geom_->offset_posr->R;
        return in_three_lanes(short_rows(rotation_) & (abs(offset_) <= Float4::all(allowed_offset))) &&
               (geom_->type == dSphereClass || is_identity(turned) || lengthens_nothing(turned));
    }

    /// The position of the geom, relative to the origin. @pre turns_safely().
    Float4 centre(const Origin &origin) const
    {
        const Float4 along_x = rotation_.x * offset_.broadcast<0>(), along_y = rotation_.y * offset_.broadcast<1>(),
                     along_z = rotation_.z * offset_.broadcast<2>();
        return origin.nearest_of_stored(body_->pos) + ((along_x + along_y) + along_z);
    }

    /// @param radius around the geom's position. The result's radius adds the round-off of centre() and of the matrices.
    Carried carried(double radius, const Origin &origin) const
    {
        const dReal *offset = geom_->offset_posr->pos;
        const double largest = std::max({std::abs(offset[0]), std::abs(offset[1]), std::abs(offset[2])});
        Carried result;
        centre(origin).store_three(result.centre);
        result.radius = round_up(radius + 4 * double{round_off} * (radius + 3 * largest));
        result.offset = round_up(largest);
        return result;
    }

private:
    const dxGeom *geom_;
    const dxPosR *body_; // a body's pose has the layout of a geom's (ode_mismatch() checks this)
    Columns rotation_;   // the body's
    Float4 offset_;
};

/// The radius of CarriedGeom::carried(); infinite for classes without a circumscribed sphere. @pre the geom has an offset.
double radius_at_offset(const dxGeom *geom);

/// The object of Broadphase::notify_at_once() and notify_closely().
class NoticedGeom
{
public:
    explicit NoticedGeom(const dxGeom *geom) : geom_(geom) {}

    /// False for a moved geom with an offset from its body, until ODE computes its pose.
    bool has_pose() const { return (geom_->gflags & GEOM_POSR_BAD) == 0; }
    const dReal *position() const { return geom_->final_posr->pos; }
    const dReal *rotation() const { return geom_->final_posr->R; }

    /// Only the matrix is checked: a geom that had no offset when it was measured, and has_pose(), has no offset now.
    bool turns_safely() const { return geom_->type == dSphereClass || keeps_within_sphere(rotation()); }

    Solid solid() const { return solid_of(geom_); }
    double radius() const { return geom_->offset_posr ? radius_at_offset(geom_) : circumscribed_radius(geom_); }

private:
    const dxGeom *geom_;
};
} // namespace ode_predictive_space

#endif
