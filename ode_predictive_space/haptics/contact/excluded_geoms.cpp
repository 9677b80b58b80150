#include "ode_predictive_space/haptics/contact/excluded_geoms.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double depth_still_outside = 0.01; // of the radius; a probe that begins at a smaller depth is outside
constexpr double shallow = 1e-4;             // m; as above for a probe without a radius

/// Whether the whole probe is in a solid, or its centre in a mesh: then the side of entry is unknown.
bool is_deep_in(const NearbyGeom &geom, const ProbePlace &probe)
{
    return geom.is_solid() ? geom.distance(probe.centre, 0) <= -probe.radius : geom.contains(probe.centre);
}

/// @param allowed m; the depth that still counts as outside.
bool is_in(const NearbyGeom &geom, const ProbePlace &probe, double allowed)
{
    return geom.distance(probe.centre, probe.radius) < probe.radius - allowed || geom.contains(probe.centre);
}
} // namespace

const ExcludedGeoms::Reported *ExcludedGeoms::before(const GeomIdentity &geom) const
{
    return find_in(reported_.before, [&](const Reported &reported) { return reported.geom == geom; });
}

bool ExcludedGeoms::excludes(const NearbyGeom &geom, const ProbePlace &probe)
{
    const bool excluded = must_exclude(geom, probe);
    reported_.now.push_back({geom.identity(), probe.centre, geom.to_local(probe.centre), excluded});
    return excluded;
}

bool ExcludedGeoms::must_exclude(const NearbyGeom &geom, const ProbePlace &probe) const
{
    if (geom.is_solid() && !is_in(geom, probe, 0))
        return false; // the usual case
    const Reported *last = before(geom.identity());
    if (probe.begins || (last != nullptr && last->excluded))
        return is_in(geom, probe, probe.begins ? depth_still_outside * probe.radius : 0);
    const bool was_there =
        last != nullptr && (geom.to_scene(last->local) - last->centre).norm() <= farthest_carried * probe.radius;
    return !was_there && is_deep_in(geom, probe) && is_deep_in(geom.later(-probe.tick), probe);
}

bool ExcludedGeoms::excludes(dGeomID geom, double depth, const ProbePlace &probe)
{
    Reported reported;
    reported.geom.id = geom;
    const Reported *last = before(reported.geom);
    const bool began_in = probe.begins && depth > std::max(shallow, depth_still_outside * probe.radius);
    reported.excluded = began_in || (last != nullptr && last->excluded && depth > 0);
    reported_.now.push_back(reported);
    return reported.excluded;
}
} // namespace ode_predictive_space::haptics
