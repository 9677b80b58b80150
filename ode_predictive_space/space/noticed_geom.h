// A geom whose move is being reported, as the broad phase reads it. It has just been written and lies in the cache.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_NOTICED_GEOM_H
#define ODE_PREDICTIVE_SPACE_SPACE_NOTICED_GEOM_H

#include "ode_predictive_space/space/geom_scene.h"

namespace ode_predictive_space
{
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
    double radius() const { return bounding_sphere(geom_); }

private:
    const dxGeom *geom_;
};
} // namespace ode_predictive_space

#endif
