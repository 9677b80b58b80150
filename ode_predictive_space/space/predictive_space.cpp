#include "ode_predictive_space/space/predictive_space.h"

#include <array>
#include <utility>

#include "ode_predictive_space/broadphase/base/prefetch.h"
#include "ode_predictive_space/ode/pair_filter.h"
#include "ode_predictive_space/space/geom_shape.h"
#include "ode_predictive_space/space/noticed_geom.h"

using namespace ode_predictive_space;

namespace
{
// ODE's dGeomMoved() calls dirty() only for geoms that are not dirty, so the flag is cleared after each notice. The bounding
// box may still be bad then, and is computed on demand. remove() and cleanGeoms() restore what ODE expects.
void listen_to(dxGeom *geom)
{
    geom->gflags &= ~GEOM_DIRTY;
}

// Prefetches the members that bits_agree() and both_enabled() read.
void prefetch_filters(const dxGeom *geom)
{
    prefetch(&geom->gflags);
    prefetch(&geom->category_bits);
}
} // namespace

dxPredictiveSpace::dxPredictiveSpace(dxSpace *parent) : dxSpace(parent)
{
    type = class_of_predictive_space;
}

// ~dxSpace() would call dxSpace::remove(), so the space is emptied here.
dxPredictiveSpace::~dxPredictiveSpace()
{
    CHECK_NOT_LOCKED(this);
    while (first)
    {
        if (cleanup)
            dGeomDestroy(first);
        else
            dxPredictiveSpace::remove(first);
    }
}

ProxyId dxPredictiveSpace::proxy_of(const dxGeom *geom)
{
    return static_cast<ProxyId>(reinterpret_cast<std::uintptr_t>(geom->next_ex) - 1);
}

GeomScene dxPredictiveSpace::scene() const
{
    return GeomScene(geoms_, hulls_, steps_at_once(), by_sphere());
}

// May run in the constructor of a geom, before the geom has a class or bounds: the next update reads them.
void dxPredictiveSpace::add(dxGeom *geom)
{
    if (static_cast<std::size_t>(count) == tuning::few_objects)
        start_predicting();
    if (predicts_)
    {
        broadphase_.make_room(1);
        fit_to_proxies();
    }
    dxSpace::add(geom);
    // Nothing is thrown from here on. A failure above (memory, an assertion of ODE) leaves the space as it was.
    geom->next_ex = nullptr;
    geom->tome_ex = nullptr;
    if (predicts_)
        enrol(geom);
}

// Throws before any change.
void dxPredictiveSpace::start_predicting()
{
    if (predicts_)
        return;
    broadphase_.make_room(static_cast<std::size_t>(count));
    fit_to_proxies();
    std::array<dxGeom *, tuning::few_objects> members;
    std::size_t left = 0;
    for (dxGeom *geom = first; geom; geom = geom->next)
        members[left++] = geom;
    while (left > 0) // in order of insertion
        enrol(members[--left]);
    predicts_ = true;
}

// @pre the arrays have room for the geom.
void dxPredictiveSpace::enrol(dxGeom *geom)
{
    const ProxyId id = broadphase_.add();
    geoms_[id] = geom;
    unclassified_.insert(id);
    access_.forget_catching_up();
    // ODE leaves this member to spaces: it holds a number, not an address. NOLINTNEXTLINE(performance-no-int-to-ptr)
    geom->next_ex = reinterpret_cast<dxGeom *>(static_cast<std::uintptr_t>(id) + 1);
}

// May run in the destructor of a geom.
void dxPredictiveSpace::remove(dxGeom *geom)
{
    CHECK_NOT_LOCKED(this);
    dUASSERT(geom->parent_space == this, "object is not in this space");
    dxSpace::remove(geom);
    if (moved_mesh_ == geom)
        moved_mesh_ = nullptr;
    if (predicts_)
        dismiss(geom);
    // Other spaces expect a moved geom to be dirty (see listen_to()), and its pose to be computed.
    if (geom->offset_posr)
        geom->recomputePosr();
    geom->gflags |= GEOM_DIRTY;
}

void dxPredictiveSpace::dismiss(dxGeom *geom)
{
    const ProxyId id = proxy_of(geom);
    broadphase_.remove(id);
    if (!broadphase_.is_prepared())
        access_.forget_catching_up();
    geoms_[id] = nullptr;
    polled_.erase(id);
    off_line_.erase(id);
    unclassified_.erase(id);
    hulls_.release(id);
    geom->next_ex = nullptr;
    fit_to_proxies();
}

void dxPredictiveSpace::fit_to_proxies()
{
    const std::size_t size = broadphase_.proxies().size();
    if (size == geoms_.size())
        return;
    if (size < geoms_.size())
    {
        free_memory(found_);
        free_memory(pairs_);
    }
    off_line_.resize(size);
    for (IdSet *set : {&polled_, &unclassified_})
        set->resize(size);
    resize_array(geoms_, size); // last: an equal size means that all are resized
}

void dxPredictiveSpace::dirty(dxGeom *geom)
{
    if (!predicts_)
        return; // the next collide reads the geom's flag
    if (geom->gflags & GEOM_POSR_BAD)
        return follow_carried(geom);
    note_followed(geom, broadphase_.notify_at_once(proxy_of(geom), NoticedGeom(geom)));
}

inline void dxPredictiveSpace::note_followed(dxGeom *geom, Followed followed)
{
    if (followed != Followed::moved)
        return follow_closely(geom, followed);
    listen_to(geom);
    note_changed_line(geom);
    access_.forget_catching_up();
}

// Follows a geom with an offset from its body, whose pose ODE computes on demand. ODE also leaves GEOM_POSR_BAD on a geom that
// has lost its offset when it changed bodies. Not inlined, so that dirty(), which ends with this call, saves no registers.
[[gnu::noinline]] void dxPredictiveSpace::follow_carried(dxGeom *geom)
{
    if (!geom->offset_posr)
    {
        geom->gflags &= ~GEOM_POSR_BAD;
        return follow_closely(geom, Followed::left);
    }
    const ProxyId id = proxy_of(geom);
    const Place &place = broadphase_.proxies().places[id];
    if (place.watch() == Watch::carried)
    {
        const CarriedGeom carried(geom);
        return note_followed(geom, carried.turns_safely(place.allowed_offset())
                                       ? broadphase_.notify_carried_at_once(id, carried.centre(broadphase_.origin()))
                                       : Followed::left);
    }
    if (!place.watches_solid())
        return follow_closely(geom, Followed::left);
    geom->recomputePosr();
    note_followed(geom, broadphase_.notify_at_once(id, NoticedGeom(geom)));
}

// Not inlined, as follow_carried().
[[gnu::noinline]] void dxPredictiveSpace::follow_closely(dxGeom *geom, Followed followed)
{
    access_.forget_catching_up();
    if (IS_SPACE(geom))
        return; // polled at each update: while it is dirty, ODE reports no further moves inside it
    if (geom->type == dTriMeshClass)
        moved_mesh_ = geom;
    listen_to(geom);
    unchanged_ += !broadphase_.notify_closely(proxy_of(geom), NoticedGeom(geom), followed);
    note_changed_line(geom);
}

// Only the sphere and shape tests follow rays along their lines.
inline void dxPredictiveSpace::note_changed_line(const dxGeom *geom)
{
    if (by_box())
        return;
    off_line_.note_change(proxy_of(geom));
}

// The classes of new geoms are known only now.
void dxPredictiveSpace::prepare()
{
    unclassified_.for_each([this](ProxyId id) {
        listen_to(geoms_[id]);
        note_changed_line(geoms_[id]);
        if (geoms_[id]->type == dTriMeshClass || IS_SPACE(geoms_[id]))
            polled_.insert(id);
    });
    unclassified_.clear();
}

// dGeomTriMeshSetData() marks the geom dirty without a notice, and ODE then sends none for its later moves. (ODE's own spaces
// miss the change or stop at an assertion, unless the geom is the first in their list.)
void dxPredictiveSpace::poll_moves()
{
    if (!unclassified_.empty())
        prepare();
    if (polled_.empty())
        return;
    polled_.for_each([this](ProxyId id) {
        if (geoms_[id]->gflags & GEOM_DIRTY)
            note_change(id);
    });
}

// The geom may have other data, even if their addresses are the same.
void dxPredictiveSpace::note_change(ProxyId id)
{
    dxGeom *geom = geoms_[id];
    if (has_data(geom))
    {
        hulls_.outdate(geom);
        hulls_.release(id);
    }
    broadphase_.mark_changed(id);
    listen_to(geom);
    note_changed_line(geom);
    access_.forget_catching_up();
}

// Marks the spaces above as ODE's dGeomMoved() does.
void dxPredictiveSpace::geom_changed(dxGeom *geom)
{
    if (predicts_)
        note_change(proxy_of(geom));
    else
        geom->gflags |= GEOM_DIRTY;
    geom->gflags |= GEOM_AABB_BAD;
    for (dxSpace *moved = this; moved; moved = moved->parent_space)
    {
        const bool noticed = moved->gflags & GEOM_DIRTY;
        moved->gflags |= GEOM_DIRTY | GEOM_AABB_BAD;
        if (moved->parent_space && !noticed)
            moved->parent_space->dirty(moved);
    }
}

// The caller then clears the flag of this space. In ODE a space is dirty while a geom in it is, because dGeomMoved() reports a
// move upwards only to the first geom that is already dirty. So no geom in this space, at any depth, may remain dirty;
// poll_moves() also reads the classes of new geoms, to find the spaces among them. Moves stay reported for the next collide.
void dxPredictiveSpace::cleanGeoms()
{
    if (!first)
        return;
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    const Lock lock(this);
    if (!predicts_)
        return clean_each();
    poll_moves();
    for (dxGeom *geom = first; geom; geom = geom->next)
        valid_aabb(geom);
}

void dxPredictiveSpace::collide(void *data, dNearCallback *callback)
{
    dAASSERT(callback);
    const Access::Turn turn(access_);
    if (!turn.granted())
        return dMessage(
            d_ERR_UASSERT,
            "dSpaceCollide(): refused, because another thread is colliding the space; one thread at a time may do so");
    if (!is_free("dSpaceCollide"))
        return;
    const bool nested_call = lock_count > 0;
    const Lock lock(this);
    ticks_ += !nested_call;
    if (!predicts_ && tests_shapes())
        start_predicting();
    if (predicts_)
        collide_predicted(nested_call, data, callback);
    else
        collide_each(data, callback);
}

// Works as a simple space, except that all boxes are compared before the first callback.
void dxPredictiveSpace::collide_each(void *data, dNearCallback *callback)
{
    struct Pair
    {
        dxGeom *one, *other;
    };
    std::array<Pair, tuning::few_objects *(tuning::few_objects - 1) / 2> pairs;
    auto end = pairs.begin();
    {
        const Access::Work work(access_);
        clean_each();
        for (dxGeom *one = first; one; one = one->next)
            for (dxGeom *other = one->next; other; other = other->next)
                if (aabbs_overlap(one, other))
                    *end++ = {one, other};
    }
    for (auto pair = pairs.begin(); pair != end; ++pair)
        call_back(pair->one, pair->other, data, callback);
}

bool dxPredictiveSpace::has_geoms_with_data() const
{
    for (const dxGeom *geom = first; geom; geom = geom->next)
        if (has_data(geom))
            return true;
    return false;
}

void dxPredictiveSpace::clean_each()
{
    for (dxGeom *geom = first; geom; geom = geom->next)
        if (geom->gflags & GEOM_DIRTY)
        {
            valid_aabb(geom);
            listen_to(geom);
        }
}

void dxPredictiveSpace::collide_predicted(bool nested_call, void *data, dNearCallback *callback)
{
    std::size_t count = 0;
    std::vector<CandidatePair> pairs = std::exchange(pairs_, {});
    {
        const Access::Work work(access_);
        count = find_reported(nested_call, pairs);
    }
    const auto visit = [&](std::size_t i) {
        call_back(geoms_[pairs[i].first], geoms_[pairs[i].second], data, callback);
    };
    if (geoms_.size() > tuning::cached_filters)
        for_each_prefetched(count, tuning::prefetch_distance, visit, [&](std::size_t i) {
            prefetch_filters(geoms_[pairs[i].first]);
            prefetch_filters(geoms_[pairs[i].second]);
        });
    else
        for (std::size_t i = 0; i < count; ++i)
            visit(i);
    pairs_ = std::move(pairs);
}

std::size_t dxPredictiveSpace::find_reported(bool nested_call, std::vector<CandidatePair> &pairs)
{
    poll_moves();
    access_.forget_catching_up();
    GeomScene now = scene();
    if (nested_call)
        broadphase_.find_new_pairs(now);
    else
        broadphase_.tick(now);
    const std::size_t count = broadphase_.report(now, pairs);
    access_.note_caught_up(broadphase_.is_prepared());
    return count;
}

// @pre the pair overlaps by the space's test of proximity.
inline void dxPredictiveSpace::call_back(dxGeom *one, dxGeom *other, void *data, dNearCallback *callback)
{
    if (!bits_agree(one, other))
        return;
    if (!both_enabled(one, other))
        return note_disabled(enabled(one) ? other : one);
    if (!wants_callback(one, other))
        return;
    ++reported_;
    callback(data, one, other);
}

// The near set keeps no pairs of disabled geoms.
void dxPredictiveSpace::note_disabled(dxGeom *geom)
{
    if (!predicts_)
        return;
    broadphase_.note_disabled(proxy_of(geom));
    access_.forget_catching_up();
}

void dxPredictiveSpace::set_proximity_test(ProximityTest test)
{
    if (test == ProximityTest::sphere)
        start_predicting();
    broadphase_.set_proximity_test(test);
    hulls_.release_all();
    if (predicts_ && !by_box())
        for (dxGeom *geom = first; geom; geom = geom->next)
            note_changed_line(geom);
    access_.forget_catching_up();
}

void dxPredictiveSpace::set_shape_margin(double margin)
{
    broadphase_.set_shape_margin(margin);
    access_.forget_catching_up();
}

void dxPredictiveSpace::set_role(dxGeom *geom, Role role)
{
    start_predicting();
    broadphase_.set_role(proxy_of(geom), role);
    access_.forget_catching_up();
}

Role dxPredictiveSpace::role(dxGeom *geom) const
{
    return predicts_ ? broadphase_.proxies().records[proxy_of(geom)].role : Role::environment;
}

void dxPredictiveSpace::set_settings(const PredictionSettings &settings)
{
    broadphase_.set_settings(settings);
    access_.forget_catching_up();
}

std::size_t dxPredictiveSpace::bytes() const
{
    return sizeof(*this) + broadphase_.bytes() + bytes_of(geoms_) + bytes_of(found_) + bytes_of(pairs_) +
           unclassified_.bytes() + polled_.bytes() + off_line_.bytes() + hulls_.bytes();
}
