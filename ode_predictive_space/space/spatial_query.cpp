// Spatial queries (dSpaceCollide2()), and the updates before them. Several threads may query at once.

#include <utility>

#include "ode_predictive_space/broadphase/near/shape_test.h"
#include "ode_predictive_space/ode/pair_filter.h"
#include "ode_predictive_space/space/geom_shape.h"
#include "ode_predictive_space/space/predictive_space.h"

using namespace ode_predictive_space;

bool dxPredictiveSpace::is_free(const char *function) const
{
    if (!access_.works())
        return true;
    dMessage(d_ERR_UASSERT,
             "%s(): refused, because the space is being updated; an AABB function of a geom class must not call it",
             function);
    return false;
}

// By box, a query notices new data only of the geom added last and of the mesh moved last, as in a simple space: polling all
// meshes costs more than a query. By sphere and by shape all meshes are polled, because an old box could hide a contact.
inline bool dxPredictiveSpace::is_caught_up() const
{
    const auto is_changed = [](const dxGeom *geom) { return geom && (flags_beside_others(geom) & GEOM_DIRTY) != 0; };
    return access_.is_caught_up() && (by_box() ? !is_changed(first) && !is_changed(moved_mesh_) : polled_.empty());
}

[[gnu::noinline]] bool dxPredictiveSpace::catch_up(const char *function)
{
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    if (!is_free(function))
        return false;
    start_predicting();
    poll_moves();
    if (access_.is_caught_up())
        return true;
    const Lock lock(this);
    const Access::Work work(access_);
    GeomScene now = scene();
    broadphase_.catch_up(now);
    access_.note_caught_up(true);
    return true;
}

std::unique_lock<std::recursive_mutex> dxPredictiveSpace::begin_query(const char *function)
{
    std::unique_lock<std::recursive_mutex> hold(access_.upkeep);
    if (!catch_up(function))
        return {};
    return hold;
}

void dxPredictiveSpace::collide2(void *data, dxGeom *geom, dNearCallback *callback)
{
    dAASSERT(geom && callback);
    const Lock lock(this);
    // By shape, an update must first find meshes that have other data now.
    if (static_cast<std::size_t>(count) <= tuning::few_objects && !tests_shapes())
        return ask_each(data, geom, callback);
    if (!is_caught_up() && !catch_up("dSpaceCollide2"))
        return;
    std::vector<ProxyId> found = lock.is_only_one ? std::exchange(found_, {}) : std::vector<ProxyId>();
    found.clear();
    const Query query = query_of(geom);
    const std::size_t on_line = find_near(query, found);
    const GeomScene now = scene();
    for_each_prefetched(
        found.size(), tuning::prefetch_distance,
        [&](std::size_t i) { answer(geoms_[found[i]], query, i < on_line, data, callback); },
        [&](std::size_t i) { now.prefetch_geom(found[i]); });
    if (lock.is_only_one)
        found_ = std::move(found);
}

void dxPredictiveSpace::ask_each(void *data, dxGeom *geom, dNearCallback *callback)
{
    bool all_boxes_known = true;
    for (dxGeom *other = first; other; other = other->next)
        all_boxes_known &= (flags_beside_others(other) & GEOM_AABB_BAD) == 0;
    if (!all_boxes_known && !compute_boxes("dSpaceCollide2"))
        return;
    const Query query = query_of(geom);
    for (dxGeom *other = first; other; other = other->next)
        answer(other, query, false, data, callback);
}

dxPredictiveSpace::Query dxPredictiveSpace::query_of(dxGeom *geom)
{
    if (flags_beside_others(geom) & GEOM_AABB_BAD)
        compute_box_of_probe(geom);
    const bool as_line = geom->type == dRayClass && !by_box() && !is_skewed(geom);
    return {geom, as_line ? line_of_ray(geom, Origin()) : std::nullopt};
}

[[gnu::noinline]] bool dxPredictiveSpace::compute_boxes(const char *function)
{
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    if (!is_free(function))
        return false;
    const Access::Work work(access_);
    for (dxGeom *geom = first; geom; geom = geom->next)
        valid_aabb(geom);
    return true;
}

[[gnu::always_inline]] inline void dxPredictiveSpace::answer(dxGeom *other, const Query &query, bool is_on_line,
                                                             void *data, dNearCallback *callback)
{
    const int flags = flags_beside_others(other);
    if (!enabled(flags))
        return;
    if (flags & GEOM_AABB_BAD)
        compute_box(other);
    if (aabbs_overlap(other, query.geom) && bits_agree(other, query.geom) && wants_callback(other, query.geom) &&
        (by_box() || may_touch(other, query, is_on_line)))
        callback(data, other, query.geom);
}

// For the sphere and shape tests: can the probe touch a geom of this space? @pre their boxes overlap.
[[gnu::noinline]] bool dxPredictiveSpace::may_touch(dxGeom *geom, const Query &query, bool is_on_line)
{
    if (query.line && !query.line->overlaps(FloatBox::around(to_box(geom->aabb))) &&
        (is_on_line || !touched_off_line(geom)))
        return false;
    if (by_sphere())
        return spheres_may_touch(geom, query.geom) && ray_may_touch(geom, query.geom);
    return query.geom->type == dRayClass || shapes_may_meet(geom, query.geom);
}

// For two primitives a check costs as much as ODE's collider. The hull of a probe is known only if the probe is in this space.
bool dxPredictiveSpace::shapes_may_meet(dxGeom *geom, dxGeom *probe)
{
    const bool probe_is_member = probe->parent_space == this;
    if (has_data(probe) ? !probe_is_member : !has_data(geom))
        return true;
    return shapes_may_touch(shape_now(geom), shape_now(probe), broadphase_.shape_margin());
}

// The shape is unknown while its hull is being made. Each query continues that work.
ConvexShape dxPredictiveSpace::shape_now(dxGeom *geom)
{
    if (!has_data(geom))
        return shape_of(geom, nullptr);
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    std::size_t steps = steps_at_once();
    return shape_of(geom, hulls_.hull_of(proxy_of(geom), geom, steps).hull);
}

// Beside a geom that a person drives, hulls are made in slices, so that no tick is long.
std::size_t dxPredictiveSpace::steps_at_once() const
{
    return broadphase_.proxies().any_hand() ? tuning::steps_per_tick : HullMaker::all_steps;
}

// The space is not updated, so that the next tick finds pairs in the same order as without this call.
void dxPredictiveSpace::make_hulls(const char *function)
{
    for (dxGeom *geom = first; geom; geom = geom->next)
        if (auto *nested = dynamic_cast<dxPredictiveSpace *>(geom))
            nested->make_hulls(function);
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    if (!tests_shapes() || !is_free(function))
        return;
    start_predicting();
    poll_moves();
    const Access::Work work(access_);
    std::size_t steps = HullMaker::all_steps;
    for (dxGeom *geom = first; geom; geom = geom->next)
        if (has_data(geom))
            hulls_.hull_of(proxy_of(geom), geom, steps);
}

[[gnu::noinline]] void dxPredictiveSpace::compute_box(dxGeom *geom)
{
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    compute_box_beside_others(geom);
}

// The probe may be in another predictive space, whose mutex then guards its box.
[[gnu::noinline]] void dxPredictiveSpace::compute_box_of_probe(dxGeom *geom)
{
    auto *owner = dynamic_cast<dxPredictiveSpace *>(geom->parent_space);
    (owner ? owner : this)->compute_box(geom);
}

[[gnu::noinline]] void dxPredictiveSpace::find_off_line()
{
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    off_line_.update([this](ProxyId id) {
        if (geoms_[id]->gflags & GEOM_POSR_BAD)
            compute_box_beside_others(geoms_[id]);
        return touched_off_line(geoms_[id]);
    });
}

// Finds all geoms whose bounding box may overlap the probe's. A ray is followed along its line; geoms that it can touch off the
// line are found by its box, and come last. @return the number of geoms found along the line.
std::size_t dxPredictiveSpace::find_near(const Query &query, std::vector<ProxyId> &found)
{
    const Origin &origin = broadphase_.origin();
    const FloatBox box = FloatBox::around(origin.around(to_box(query.geom->aabb)));
    const std::optional<RayProbe> line = query.line ? line_of_ray(query.geom, origin) : std::nullopt;
    if (!line)
    {
        broadphase_.walk(BoxProbe(box), [&](ProxyId id) { found.push_back(id); });
        return 0;
    }
    if (!off_line_.known())
        find_off_line();
    auto find = [&](const auto &probe, bool off_line) {
        broadphase_.walk(probe, [&](ProxyId id) {
            if (off_line_.contains(id) == off_line)
                found.push_back(id);
        });
    };
    find(*line, false);
    const std::size_t on_line = found.size();
    if (!off_line_.empty())
        find(BoxProbe(box), true);
    return on_line;
}
