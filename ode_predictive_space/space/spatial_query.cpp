// Spatial queries, by dSpaceCollide2(), and what brings the space up to date for them. Several threads may ask at once.

#include <utility>

#include "ode_predictive_space/broadphase/near/shape_test.h"
#include "ode_predictive_space/space/geom_shape.h"
#include "ode_predictive_space/space/pair_filter.h"
#include "ode_predictive_space/space/predictive_space.h"

using namespace ode_predictive_space;

bool dxPredictiveSpace::is_free(const char *function) const
{
    if (!access_.works())
        return true;
    dMessage(d_ERR_UASSERT, "%s(): not answered, because the space is just being brought up to date", function);
    return false;
}

// By box, polling all meshes as poll_moves() does would cost more than a question. So a question sees other data only when they were
// given to the geom that was added or moved last, as in a simple space. By sphere and by shape all meshes are polled: an old box could
// hide a contact.
inline bool dxPredictiveSpace::is_caught_up() const
{
    const auto is_changed = [](const dxGeom *geom) { return geom && (flags_beside_others(geom) & GEOM_DIRTY) != 0; };
    return access_.is_caught_up() && (by_box() ? !is_changed(first) && !is_changed(moved_mesh_) : polled_.empty());
}

// The threads that ask meanwhile wait.
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

std::unique_lock<std::recursive_mutex> dxPredictiveSpace::begin_inquiry(const char *function)
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
    // The shape test has to notice first which data were changed in place.
    if (static_cast<std::size_t>(count) <= tuning::few_objects && !looks_at_shapes())
        return ask_each(data, geom, callback);
    if (!is_caught_up() && !catch_up("dSpaceCollide2"))
        return;
    std::vector<ProxyId> found = lock.is_only_one ? std::exchange(found_, {}) : std::vector<ProxyId>();
    found.clear();
    const Question question = question_of(geom);
    const std::size_t on_line = find_near(question, found);
    const GeomScene now = scene();
    for_each_prefetched(
        found.size(), tuning::turns_ahead,
        [&](std::size_t i) { answer(geoms_[found[i]], question, i < on_line, data, callback); },
        [&](std::size_t i) { now.prefetch_geom(found[i]); });
    if (lock.is_only_one)
        found_ = std::move(found);
}

// Among few geoms, no index pays.
void dxPredictiveSpace::ask_each(void *data, dxGeom *geom, dNearCallback *callback)
{
    bool all_boxes_known = true;
    for (dxGeom *other = first; other; other = other->next)
        all_boxes_known &= (flags_beside_others(other) & GEOM_AABB_BAD) == 0;
    if (!all_boxes_known && !compute_boxes("dSpaceCollide2"))
        return;
    const Question question = question_of(geom);
    for (dxGeom *other = first; other; other = other->next)
        answer(other, question, false, data, callback);
}

// The sphere and shape tests follow a ray along its line.
dxPredictiveSpace::Question dxPredictiveSpace::question_of(dxGeom *geom)
{
    if (flags_beside_others(geom) & GEOM_AABB_BAD)
        compute_box_of_probe(geom);
    const bool as_line = geom->type == dRayClass && !by_box() && !is_skewed(geom);
    return {geom, as_line ? line_of_ray(geom, Origin()) : std::nullopt};
}

// The threads that ask meanwhile wait.
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

[[gnu::always_inline]] inline void dxPredictiveSpace::answer(dxGeom *other, const Question &question, bool is_on_line,
                                                             void *data, dNearCallback *callback)
{
    // Asked here, because may_touch() is a call, and a space of primitives has no other pairs.
    const auto are_primitives = [&] {
        return by_shape() && !question.line && !has_data(other) && !has_data(question.geom);
    };
    const int flags = flags_beside_others(other);
    if (!enabled(flags))
        return;
    if (flags & GEOM_AABB_BAD)
        compute_box(other);
    if (aabbs_overlap(other, question.geom) && bits_agree(other, question.geom) &&
        wants_callback(other, question.geom) &&
        (by_box() || are_primitives() || may_touch(other, question, is_on_line)))
        callback(data, other, question.geom);
}

// By the sphere and shape tests: can a geom of this space be touched where the boxes overlap?
[[gnu::noinline]] bool dxPredictiveSpace::may_touch(dxGeom *geom, const Question &question, bool is_on_line)
{
    if (question.line && !question.line->overlaps(FloatBox::around(to_box(geom->aabb))) &&
        (is_on_line || !touched_off_line(geom)))
        return false;
    if (by_sphere())
        return spheres_may_touch(geom, question.geom) && ray_may_touch(geom, question.geom);
    return question.geom->type == dRayClass || shapes_may_meet(geom, question.geom);
}

// Serves the shape test. A look costs as much as ODE takes to find the contacts of two primitives, so it is made at geoms with data only.
bool dxPredictiveSpace::shapes_may_meet(dxGeom *geom, dxGeom *probe)
{
    const bool probe_is_member = probe->parent_space == this;
    if (has_data(probe) ? !probe_is_member : !has_data(geom))
        return true;
    return shapes_may_touch(shape_now(geom), shape_now(probe), broadphase_.shape_margin());
}

// None when it is not known, or made of data that are not ready for looks. Each question goes on with these.
ConvexShape dxPredictiveSpace::shape_now(dxGeom *geom)
{
    if (!has_data(geom))
        return shape_of(geom, nullptr);
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    std::size_t steps = steps_at_once();
    return shape_of(geom, hulls_.hull_of(proxy_of(geom), geom, steps).hull);
}

// A person never feels that a tick takes long.
std::size_t dxPredictiveSpace::steps_at_once() const
{
    return broadphase_.proxies().any_hand() ? tuning::steps_per_tick : HullMaker::all_steps;
}

// The space is not brought up to date: the next tick finds the pairs in the same order as without this.
void dxPredictiveSpace::make_hulls(const char *function)
{
    for (dxGeom *geom = first; geom; geom = geom->next)
        if (auto *nested = dynamic_cast<dxPredictiveSpace *>(geom))
            nested->make_hulls(function);
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    if (!looks_at_shapes() || !is_free(function))
        return;
    start_predicting();
    poll_moves();
    const Access::Work work(access_);
    std::size_t steps = HullMaker::all_steps;
    for (dxGeom *geom = first; geom; geom = geom->next)
        if (has_data(geom))
            hulls_.hull_of(proxy_of(geom), geom, steps);
}

// Boxes that no tick has needed are computed when they are first asked for.
[[gnu::noinline]] void dxPredictiveSpace::compute_box(dxGeom *geom)
{
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    compute_box_beside_others(geom);
}

// The probe may be a geom of another predictive space, which several threads ask, too.
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

// All geoms whose bounding box may overlap that of the probe. A ray is followed along its line; the geoms that it can touch without
// meeting their box are found by its box, and come last.
//
// @return the number of geoms found along the line.
std::size_t dxPredictiveSpace::find_near(const Question &question, std::vector<ProxyId> &found)
{
    const Origin &origin = broadphase_.origin();
    const FloatBox box = FloatBox::around(origin.around(to_box(question.geom->aabb)));
    const std::optional<RayProbe> line = question.line ? line_of_ray(question.geom, origin) : std::nullopt;
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
