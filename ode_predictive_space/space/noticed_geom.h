// A geom whose move is being reported, as the broad phase reads it. It has just been written and lies in the cache.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_NOTICED_GEOM_H
#define ODE_PREDICTIVE_SPACE_SPACE_NOTICED_GEOM_H

#include <algorithm>
#include <cmath>

#include "ode_predictive_space/space/geom_scene.h"

namespace ode_predictive_space
{
/// No geom is followed at an offset with larger coordinates.
constexpr float most_offset = 1e15f;

/// A geom with an offset from its body. Its own pose is computed from those two only where it is needed.
class CarriedGeom
{
public:
    explicit CarriedGeom(const dxGeom *geom)
        : geom_(geom), body_(reinterpret_cast<const dxPosR *>(dBodyGetPosition(geom->body))), rotation_(body_->R),
          offset_(Float4::nearest_of_stored(geom->offset_posr->pos, 1))
    {}

    /// Both matrices may have changed, and the offset may have become longer than a radius allows for.
    bool turns_safely(float allowed_offset) const
    {
        const dMatrix3 &turned = geom_->offset_posr->R;
        return in_three_lanes(short_rows(rotation_) & (abs(offset_) <= Float4::all(allowed_offset))) &&
               (geom_->type == dSphereClass || is_identity(turned) || lengthens_nothing(turned));
    }

    /// The position of the geom, from the origin.
    ///
    /// @pre it turns safely.
    Float4 centre(const Origin &origin) const
    {
        const Float4 along_x = rotation_.x * offset_.broadcast<0>(), along_y = rotation_.y * offset_.broadcast<1>(),
                     along_z = rotation_.z * offset_.broadcast<2>();
        return origin.nearest_of_stored(body_->pos) + ((along_x + along_y) + along_z);
    }

    /// @param radius around the position of the geom. It is enlarged by what may be lost by rounding in the functions above.
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
    const dxPosR *body_; // ODE keeps the pose of a body as that of a geom
    Columns rotation_;   // of the body
    Float4 offset_;
};

/// The radius that CarriedGeom::carried() has for a geom with an offset; infinite for classes without a circumscribed sphere.
double radius_at_offset(const dxGeom *geom);

/// What Broadphase::report_at_once() and report_closely() ask.
class NoticedGeom
{
public:
    explicit NoticedGeom(const dxGeom *geom) : geom_(geom) {}

    /// (The position of a geom with an offset from its body is bad when it has been moved.)
    bool has_pose() const { return (geom_->gflags & GEOM_POSR_BAD) == 0; }
    const dReal *position() const { return geom_->final_posr->pos; }
    const dReal *rotation() const { return geom_->final_posr->R; }

    /// A geom that has a pose, and had no offset when it was looked at, has none now: only its matrix may have changed.
    bool turns_safely() const { return geom_->type == dSphereClass || keeps_within_sphere(rotation()); }

    Solid solid() const { return solid_of(geom_); }
    double radius() const { return geom_->offset_posr ? radius_at_offset(geom_) : circumscribed_radius(geom_); }

private:
    const dxGeom *geom_;
};
} // namespace ode_predictive_space

#endif
