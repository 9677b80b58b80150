// Questions: dSpaceCollide2() and what brings the space up to date for them. Several threads may ask at once.

#include <utility>

#include "ode_predictive_space/space/one_at_a_time.h"
#include "ode_predictive_space/space/pair_filter.h"
#include "ode_predictive_space/space/predictive_space.h"

using namespace ode_predictive_space;

bool dxPredictiveSpace::is_free(const char *function) const
{
    if (!working_.load(std::memory_order_relaxed))
        return true;
    dMessage(d_ERR_UASSERT, "%s(): not answered, because the space is just being brought up to date", function);
    return false;
}

bool dxPredictiveSpace::catch_up(const char *function)
{
    return is_caught_up() || catch_up_alone(function);
}

inline bool dxPredictiveSpace::is_caught_up() const
{
    return caught_up_.load(std::memory_order_seq_cst) && !is_silently_changed();
}

// See poll_moves().
inline bool dxPredictiveSpace::is_silently_changed() const
{
    bool changed = false;
    if (polled_count_ > 0)
        polled_.for_each([&](ProxyId id) { changed |= (flags_beside_others(geoms_[id]) & GEOM_DIRTY) != 0; });
    return changed;
}

// The threads that ask meanwhile wait.
[[gnu::noinline]] bool dxPredictiveSpace::catch_up_alone(const char *function)
{
    const std::lock_guard<std::recursive_mutex> hold(upkeep_);
    if (!is_free(function))
        return false;
    poll_moves();
    if (caught_up_)
        return true;
    const Lock lock(this);
    const Work work(working_);
    if (by_sphere())
        note_changed_lines(broadphase_.changed());
    GeomScene now = scene();
    broadphase_.catch_up(now);
    caught_up_.store(true, std::memory_order_release);
    return true;
}

// Questions of other threads that have begun look at the broad phase without a lock; those that begin now wait. Changes that are
// not necessary are left for later while there are such questions.
std::unique_lock<std::recursive_mutex> dxPredictiveSpace::begin_inquiry(const char *function)
{
    std::unique_lock<std::recursive_mutex> hold(upkeep_);
    if (!is_free(function))
        return {};
    const bool was_caught_up = caught_up_.exchange(false);
    const bool is_asked = __atomic_load_n(&lock_count, __ATOMIC_SEQ_CST) > 0 &&
                          ticking_thread_.load(std::memory_order_relaxed) != std::this_thread::get_id();
    const bool may_change = !was_caught_up || !is_asked;
    const bool changes = may_change && broadphase_.want_predictions();
    caught_up_.store(was_caught_up && !changes, std::memory_order_release);
    catch_up(function);
    return hold;
}

void dxPredictiveSpace::collide2(void *data, dxGeom *geom, dNearCallback *callback)
{
    dAASSERT(geom && callback);
    const Lock lock(this);
    if (!catch_up("dSpaceCollide2"))
        return;
    predict_when_asked_often();
    std::vector<ProxyId> found = lock.is_only_one ? std::exchange(found_, {}) : std::vector<ProxyId>();
    found.clear();
    find_near(geom, found);
    const GeomScene now = scene();
    for_each_prefetched(
        found.size(), tuning::turns_ahead,
        [&](std::size_t i) {
            dxGeom *other = geoms_[found[i]];
            const int flags = flags_beside_others(other);
            if (!bits_agree(other, geom) || !enabled(flags))
                return;
            if (flags & GEOM_AABB_BAD)
                compute_box(other);
            if (now.overlap(other, geom) && wants_callback(other, geom))
                callback(data, other, geom);
        },
        [&](std::size_t i) { now.prefetch_geom(found[i]); });
    if (lock.is_only_one)
        found_ = std::move(found);
}

// Boxes that no tick has needed are computed when they are first asked for.
[[gnu::noinline]] void dxPredictiveSpace::compute_box(dxGeom *geom)
{
    const std::lock_guard<std::recursive_mutex> hold(upkeep_);
    compute_box_beside_others(geom);
}

// The probe may be a geom of another predictive space, which several threads ask, too.
[[gnu::noinline]] void dxPredictiveSpace::compute_box_of_probe(dxGeom *geom)
{
    auto *owner = dynamic_cast<dxPredictiveSpace *>(geom->parent_space);
    (owner ? owner : this)->compute_box(geom);
}

// Objects without predictions get them as time passes. In a program that only asks, no time passes, and each question would look
// at all of these objects. After some questions this has cost as much as the predictions.
inline void dxPredictiveSpace::predict_when_asked_often()
{
    if (broadphase_.mode() != Mode::predicting)
        count_question();
}

// See begin_inquiry().
[[gnu::noinline]] void dxPredictiveSpace::count_question()
{
    const std::unique_lock<std::recursive_mutex> hold(upkeep_, std::try_to_lock);
    if (!hold)
        return;
    if (std::exchange(asked_at_, broadphase_.now()) != broadphase_.now())
        questions_ = 0;
    else if (questions_ < tuning::questions_worth_predictions)
        ++questions_;
    else
        return;
    if (questions_ < tuning::questions_worth_predictions)
        return;
    caught_up_ = false;
    const bool is_asked = __atomic_load_n(&lock_count, __ATOMIC_SEQ_CST) > 1;
    if (is_asked)
        --questions_;
    else
        broadphase_.predict_all_waiting();
    caught_up_ = is_asked;
    catch_up("dSpaceCollide2");
}

// Left to the first ray that asks: geoms change at each tick, and few programs send rays at each tick.
[[gnu::noinline]] void dxPredictiveSpace::find_off_line()
{
    const std::lock_guard<std::recursive_mutex> hold(upkeep_);
    line_unknown_.for_each([this](ProxyId id) {
        if (geoms_[id]->gflags & GEOM_POSR_BAD)
            compute_box_beside_others(geoms_[id]);
        const bool off_line = touched_off_line(geoms_[id]), was_off_line = off_line_.contains(id);
        if (off_line == was_off_line)
            return;
        off_line ? off_line_.insert(id) : off_line_.erase(id);
        off_line_count_ += off_line ? 1 : std::size_t{0} - 1;
    });
    line_unknown_.clear();
    lines_known_.store(true, std::memory_order_release);
}

// All geoms whose bounding box may overlap that of `geom`. By the sphere test, a ray is followed along its line; only geoms that
// a ray can touch without meeting their box are looked for in the box of the ray.
void dxPredictiveSpace::find_near(dxGeom *geom, std::vector<ProxyId> &found)
{
    if (flags_beside_others(geom) & GEOM_AABB_BAD)
        compute_box_of_probe(geom);
    const bool as_line = geom->type == dRayClass && by_sphere() && !is_skewed(geom);
    const std::optional<RayProbe> line = as_line ? line_of_ray(geom) : std::nullopt;
    const FloatBox box = FloatBox::around(to_box(geom->aabb));
    if (!line)
    {
        broadphase_.query(box, [&](ProxyId id) { found.push_back(id); });
        return;
    }
    if (!lines_known_.load(std::memory_order_acquire))
        find_off_line();
    auto find = [&](const auto &probe, bool off_line) {
        broadphase_.walk(probe, [&](ProxyId id) {
            if (off_line_.contains(id) == off_line)
                found.push_back(id);
        });
    };
    find(*line, false);
    if (off_line_count_ > 0)
        find(BoxProbe(box), true);
}
