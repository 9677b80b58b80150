#include "ode_predictive_space/space/geom_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/base/prefetch.h"
#include "ode_predictive_space/ode/pair_filter.h"
#include "ode_predictive_space/space/geom_shape.h"
#include "ode_predictive_space/space/noticed_geom.h"

namespace ode_predictive_space
{
namespace
{
// Relative round-off: rotations are not exactly orthonormal, and spheres that touch by dCollide() may be slightly apart.
constexpr double tolerance = sizeof(dReal) == sizeof(double) ? 1e-9 : 1e-5;

// A geom with an offset circles around its body.
Vector3 velocity_of(dxGeom *geom)
{
    if (!dBodyIsEnabled(geom->body))
        return Vector3::Zero();
    const dReal *linear = dBodyGetLinearVel(geom->body);
    if (!geom->offset_posr)
        return Vector3(linear[0], linear[1], linear[2]);
    dVector3 at_centre;
    const dReal *centre = geom->final_posr->pos;
    dBodyGetPointVel(geom->body, centre[0], centre[1], centre[2], at_centre);
    return Vector3(at_centre[0], at_centre[1], at_centre[2]);
}

// A sphere is the same for any matrix; a ray needs only the column of its direction, which is all that dGeomRaySet() sets.
double skew_of_geom(const dxGeom *geom)
{
    if (!(geom->gflags & GEOM_PLACEABLE) || geom->type == dSphereClass)
        return 0;
    const dReal *R = geom->final_posr->R;
    return geom->type == dRayClass ? std::abs(Vector3(R[2], R[6], R[10]).squaredNorm() - 1) : skew_of(R);
}

// Gap in which ODE's colliders may find a contact: in single precision, they round coordinates far from the origin.
double rounding_at([[maybe_unused]] const Box &bounds)
{
    if constexpr (sizeof(dReal) == sizeof(double))
        return 0;
    else
        return 4 * double{std::numeric_limits<dReal>::epsilon()} *
               std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().cwiseAbs().maxCoeff());
}

bool is_finite(const Box &box)
{
    constexpr double most = std::numeric_limits<double>::max();
    return box.min().minCoeff() >= -most && box.max().maxCoeff() <= most;
}

// The sphere of the sphere test, by the geom's present state alone: reports do not depend on the past. @pre the box is valid.
class JudgedSphere
{
public:
    explicit JudgedSphere(const dxGeom *geom) : geom_(geom), bounds_(to_box(geom->aabb))
    {
        if (judged_by_box_alone(geom) || !is_finite(bounds_))
            return;
        const double circumscribed = circumscribed_radius(geom);
        centre_ = bounds_.center();
        radius_ = std::isfinite(circumscribed) ? circumscribed : 0.5 * bounds_.diagonal().norm();
    }

    // True if any value is NaN or infinite, so that such a pair is reported. Most pairs touch, and save the check of skew.
    bool may_touch(const JudgedSphere &other) const
    {
        const double squared = (centre_ - other.centre_).squaredNorm();
        const auto is_within = [squared](double reach) { return !(squared > reach * reach); };
        return is_within(radius_ + other.radius_) || is_within(enlarged() + other.enlarged());
    }

private:
    double enlarged() const
    {
        const double skew = skew_of_geom(geom_);
        return skew <= most_skew ? radius_ * (1 + skew) + rounding_at(bounds_)
                                 : std::numeric_limits<double>::infinity();
    }

    const dxGeom *geom_;
    Box bounds_;
    Vector3 centre_ = Vector3::Zero();
    double radius_ = std::numeric_limits<double>::infinity(); // stays infinite for geoms that are judged by their boxes
};
} // namespace

bool spheres_may_touch(const dxGeom *one, const dxGeom *other)
{
    return found_by_libccd(one, other) || JudgedSphere(one).may_touch(JudgedSphere(other));
}

bool is_skewed(const dxGeom *geom)
{
    return !(skew_of_geom(geom) <= most_skew);
}

bool judged_by_box_alone(const dxGeom *geom)
{
    return geom->type == dHeightfieldClass || geom->type == dGeomTransformClass || geom->type >= dFirstSpaceClass;
}

bool touched_off_line(const dxGeom *geom)
{
    return geom->type == dConvexClass || judged_by_box_alone(geom) || is_skewed(geom);
}

std::optional<RayProbe> line_of_ray(dxGeom *ray, const Origin &origin)
{
    ray->recomputePosr();
    const dReal *start = ray->final_posr->pos, *R = ray->final_posr->R, length = static_cast<dxRay *>(ray)->length;
    const Vector3 begin = Vector3(start[0], start[1], start[2]) - origin.place();
    const Vector3 end = begin + double{length} * Vector3(R[2], R[6], R[10]);
    if (!FloatBox::around(Box(begin.cwiseMin(end), begin.cwiseMax(end))).bounded())
        return std::nullopt;
    // ODE finds a hit on a sphere or a cylinder if a difference of squared distances is not negative. In single precision, a
    // ray can hit what it misses by up to its length times the root of an epsilon.
    constexpr double miss = sizeof(dReal) == sizeof(double) ? 0 : 1e-3;
    return RayProbe(begin, end, miss * length + double{origin.doubt().largest_of_three()});
}

bool ray_may_touch(dxGeom *probe, const dxGeom *geom)
{
    if (probe->type != dRayClass || touched_off_line(geom) || is_skewed(probe))
        return true;
    const std::optional<RayProbe> line = line_of_ray(probe, Origin());
    return !line || line->overlaps(FloatBox::around(to_box(geom->aabb)));
}

// Not inlined: most geoms have no offset.
[[gnu::noinline]] double radius_at_offset(const dxGeom *geom)
{
    const double radius = circumscribed_radius(geom);
    return std::isfinite(radius) ? CarriedGeom(geom).carried(radius, Origin()).radius : radius;
}

double circumscribed_radius(const dxGeom *geom)
{
    const dReal *sizes = sizes_of(geom);
    switch (geom->type)
    {
    case dSphereClass:
        return sizes[0] * (1 + tolerance);
    case dBoxClass:
    {
        const double x = sizes[0], y = sizes[1], z = sizes[2];
        return std::sqrt(x * x + y * y + z * z) / 2 * (1 + tolerance);
    }
    case dCapsuleClass:
        return (sizes[0] + 0.5 * sizes[1]) * (1 + tolerance);
    case dCylinderClass:
    {
        const double radius = sizes[0], half = 0.5 * sizes[1];
        return std::sqrt(radius * radius + half * half) * (1 + tolerance);
    }
    default:
        return std::numeric_limits<double>::infinity();
    }
}

Solid solid_of(const dxGeom *geom)
{
    const dReal *sizes = sizes_of(geom);
    switch (geom->type)
    {
    case dSphereClass:
        return {Watch::sphere, static_cast<float>(sizes[0])};
    case dBoxClass:
        return {Watch::box, static_cast<float>(sizes[0] / 2), static_cast<float>(sizes[1] / 2),
                static_cast<float>(sizes[2] / 2)};
    case dCapsuleClass:
        return {Watch::capsule, static_cast<float>(sizes[0]), 0, static_cast<float>(sizes[1] / 2)};
    case dCylinderClass:
        // In single precision, the error of ODE's box, the root of a small difference, exceeds the margin of a tight box.
        if (sizeof(dReal) < sizeof(double))
            return {};
        return {Watch::cylinder, static_cast<float>(sizes[0]), 0, static_cast<float>(sizes[1] / 2)};
    default:
        return {};
    }
}

void GeomScene::prefetch_geom(ProxyId id) const
{
    constexpr std::size_t most_sizes = 3;
    prefetch_block<sizeof(dxGeom) + most_sizes * sizeof(dReal)>(geoms_[id]);
}

void GeomScene::prefetch_pose(ProxyId id) const
{
    prefetch_block<sizeof(dxPosR)>(geoms_[id]->final_posr);
}

// Prefetches for later visits, unless the scene fits into the cache.
template <typename Visit, typename... Fetches>
void GeomScene::for_each(std::size_t count, Visit visit, Fetches... fetches) const
{
    if (overflows_cache_)
        for_each_prefetched(count, tuning::prefetch_distance, visit, fetches...);
    else
        for (std::size_t i = 0; i < count; ++i)
            visit(i);
}

static void measure_geom(dxGeom *geom, Place &place, const Origin &origin)
{
    if (geom->type <= dCylinderClass)
    {
        geom->recomputePosr();
        if (place.measure(solid_of(geom), geom->final_posr->pos, geom->final_posr->R, origin))
            return;
    }
    place.set_tight(origin.around(to_box(valid_aabb(geom))));
}

void GeomScene::measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin)
{
    for_each(
        count, [&](std::size_t i) { measure_geom(geoms_[ids[i]], places[ids[i]], origin); },
        [&](std::size_t i) { prefetch_geom(ids[i]); },
        [&](std::size_t i) {
            prefetch_pose(ids[i]);
            prefetch(&places[ids[i]]);
        });
}

void GeomScene::observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &origin)
{
    const auto prefetch_motion = [&](std::size_t i) {
        prefetch_pose(ids[i]);
        if (const dBodyID body = geoms_[ids[i]]->body)
            prefetch_block<2 * sizeof(dVector3)>(
                dBodyGetLinearVel(body)); // and the angular velocity behind it, for a geom with an offset
    };
    for_each(
        count, [&](std::size_t i) { seen[i] = observation(ids[i], origin); },
        [&](std::size_t i) { prefetch_geom(ids[i]); }, prefetch_motion);
}

void GeomScene::follow(const ProxyId *ids, std::size_t count, ConvexShape *const *shapes, double *moves)
{
    for_each(
        count, [&](std::size_t i) { moves[i] = follow_geom(ids[i], geoms_[ids[i]], hulls_, steps_left_, *shapes[i]); },
        [&](std::size_t i) { prefetch_geom(ids[i]); },
        [&](std::size_t i) {
            prefetch_pose(ids[i]);
            prefetch_block<sizeof(ConvexShape)>(shapes[i]);
        });
}

bool GeomScene::hull_is_outdated(ProxyId id, const ConvexShape &shape)
{
    if (shape.hull)
        return HullStore::is_outdated(geoms_[id], *shape.hull);
    return !hulls_.hull_of(id, geoms_[id], steps_left_).is_being_made;
}

Box GeomScene::bounds(ProxyId id)
{
    return to_box(valid_aabb(geoms_[id]));
}

// Does the geom turn about its position, so that a bounding sphere measured earlier still holds it?
static bool turns_safely(const dxGeom *geom)
{
    if (geom->offset_posr)
        return CarriedGeom(geom).turns_safely(most_offset);
    return geom->type == dSphereClass || (geom->body && keeps_within_sphere(geom->final_posr->R));
}

// None if the point is unknown or not finite.
static std::optional<Vector3> pivot_of(dxGeom *geom)
{
    geom->recomputePosr();
    if (!turns_safely(geom))
        return std::nullopt;
    const dReal *position = geom->final_posr->pos;
    const Vector3 centre(position[0], position[1], position[2]);
    return centre.allFinite() ? std::optional(centre) : std::nullopt;
}

// A geom with a body has the pose of the body, about which its offset turns. Planes and spaces have no position.
SampledPose GeomScene::pose(ProxyId id)
{
    dxGeom *geom = geoms_[id];
    if (!(geom->gflags & GEOM_PLACEABLE))
        return {Vector3::Zero(), Eigen::Matrix3d::Identity(), 0, false};
    geom->recomputePosr();
    const dReal *position = geom->body ? dBodyGetPosition(geom->body) : geom->final_posr->pos;
    const dReal *R = geom->body ? dBodyGetRotation(geom->body) : geom->final_posr->R;
    const Vector3 pivot(position[0], position[1], position[2]);
    SampledPose pose{pivot, Eigen::Matrix3d::Identity(),
                     8 * double{std::numeric_limits<dReal>::epsilon()} * pivot.norm(), true};
    const bool turning_shows = geom->type != dSphereClass || geom->offset_posr;
    if (turning_shows)
        pose.rotation << R[0], R[1], R[2], R[4], R[5], R[6], R[8], R[9], R[10];
    return pose;
}

Observation GeomScene::observation(ProxyId id, const Origin &origin)
{
    dxGeom *geom = geoms_[id];
    Observation seen;
    seen.centre = pivot_of(geom);
    seen.radius = seen.centre ? circumscribed_radius(geom) : std::numeric_limits<double>::infinity();
    if (geom->offset_posr && seen.centre)
        seen.carried = CarriedGeom(geom).carried(seen.radius, origin);
    seen.is_costly = has_data(geom);
    if (geom->body && !dBodyIsKinematic(geom->body))
        seen.velocity = velocity_of(geom);
    return seen;
}

bool GeomScene::is_excluded(ProxyId first, ProxyId second)
{
    const dxGeom *one = geoms_[first], *other = geoms_[second];
    return !bits_agree(one, other) || (one->body && one->body == other->body);
}

void GeomScene::find_disabled(const std::vector<ProxyId> &ids, IdSet &disabled)
{
    for (ProxyId id : ids)
        if (!enabled(geoms_[id]))
            disabled.insert(id);
}
} // namespace ode_predictive_space
