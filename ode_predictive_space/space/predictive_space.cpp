#include "ode_predictive_space/space/predictive_space.h"

#include <algorithm>
#include <utility>

using namespace ode_predictive_space;

namespace
{
bool enabled(const dxGeom *geom)
{
    return (geom->gflags & GEOM_ENABLE_TEST_MASK) == GEOM_ENABLE_TEST_VALUE;
}

// Both lines of a geom that the filters read.
void prefetch_filters(const dxGeom *geom)
{
    prefetch(&geom->gflags);
    prefetch(&geom->category_bits);
}

// ODE's own classes have nothing to add to the test of the boxes.
[[gnu::noinline]] bool user_classes_agree(dxGeom *first, dxGeom *second)
{
    return (first->type < dFirstUserClass || first->AABBTest(second, second->aabb) != 0) &&
           (second->type < dFirstUserClass || second->AABBTest(first, first->aabb) != 0);
}

// What collideAABBs() asks beside overlap, in this function and the next. Bits, bodies and the rest change without notice:
// they are read here, each time. First the bits: pairs that overlap for good, such as walls at their edges, are most often left
// out by these.
inline bool bits_agree(const dxGeom *first, const dxGeom *second)
{
    return ((first->category_bits & second->collide_bits) | (second->category_bits & first->collide_bits)) != 0;
}

inline bool wants_callback(dxGeom *first, dxGeom *second)
{
    if (first->body == second->body && first->body)
        return false;
    return std::max(first->type, second->type) < dFirstUserClass || user_classes_agree(first, second);
}

// ODE's dGeomMoved() calls dirty() only for geoms that are not dirty. The flag is cleared although the bounding box may still
// be bad: it is computed when somebody needs it. remove() and cleanGeoms() restore what ODE expects.
void listen_to(dxGeom *geom)
{
    geom->gflags &= ~GEOM_DIRTY;
}
} // namespace

dxPredictiveSpace::dxPredictiveSpace(dxSpace *parent) : dxSpace(parent)
{
    type = class_of_predictive_space;
}

// When ~dxSpace() runs, remove() is no longer ours. So this empties the space, as that would.
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
    return GeomScene(geoms_, broadphase_.measure() == Proximity::sphere);
}

// May run within the constructor of a geom, when neither its class nor its bounds exist: they are asked for at the next
// collide.
void dxPredictiveSpace::add(dxGeom *geom)
{
    dxSpace::add(geom);
    const ProxyId id = broadphase_.add();
    if (id >= geoms_.size())
    {
        grow(geoms_, id + 1);
        polled_.resize(geoms_.size());
        off_line_.resize(geoms_.size());
        unclassified_.resize(geoms_.size());
    }
    geoms_[id] = geom;
    unclassified_.insert(id);
    caught_up_ = false;
    // A number, not an address, in the member that ODE gives to spaces. NOLINTNEXTLINE(performance-no-int-to-ptr)
    geom->next_ex = reinterpret_cast<dxGeom *>(static_cast<std::uintptr_t>(id) + 1);
    geom->tome_ex = nullptr;
}

// May run within the destructor of a geom.
void dxPredictiveSpace::remove(dxGeom *geom)
{
    CHECK_NOT_LOCKED(this);
    dUASSERT(geom->parent_space == this, "object is not in this space");
    const ProxyId id = proxy_of(geom);
    dxSpace::remove(geom);
    broadphase_.remove(id);
    geoms_[id] = nullptr;
    polled_count_ -= polled_.contains(id);
    polled_.erase(id);
    off_line_count_ -= off_line_.contains(id);
    off_line_.erase(id);
    unclassified_.erase(id);
    geom->next_ex = nullptr;
    // In here a geom with a bad box need not be dirty (see listen_to()), nor a space in which a geom is;
    // elsewhere they must be.
    if ((geom->gflags & GEOM_AABB_BAD) || IS_SPACE(geom))
        geom->gflags |= GEOM_DIRTY;
}

void dxPredictiveSpace::dirty(dxGeom *geom)
{
    caught_up_ = false;
    listen_to(geom);
    broadphase_.notice_move(proxy_of(geom), NoticedGeom(geom));
}

// Only now is the class of new geoms known.
void dxPredictiveSpace::classify_new()
{
    if (unclassified_.empty())
        return;
    unclassified_.for_each([this](ProxyId id) {
        prefetch(later(geoms_, id, 16));
        listen_to(geoms_[id]);
        if (geoms_[id]->type == dTriMeshClass || IS_SPACE(geoms_[id]))
        {
            polled_.insert(id);
            ++polled_count_;
        }
        if (touched_off_line(geoms_[id]))
        {
            off_line_.insert(id);
            ++off_line_count_;
        }
    });
    unclassified_.clear();
}

// dGeomTriMeshSetData() marks the geom dirty and tells nobody, and ODE then keeps silent about its later moves too. (ODE's
// own spaces miss it as well, or stop at an assertion, unless the geom happens to be the first in their list.)
void dxPredictiveSpace::notice_unreported_moves()
{
    if (!caught_up_)
        classify_new();
    if (polled_count_ == 0)
        return;
    polled_.for_each([this](ProxyId id) {
        if (geoms_[id]->gflags & GEOM_DIRTY)
        {
            broadphase_.mark_moved(id);
            listen_to(geoms_[id]);
            caught_up_ = false;
        }
    });
}

// Computes the boxes that the space itself may not need yet. What has moved is still noted, for the next collide.
void dxPredictiveSpace::cleanGeoms()
{
    Lock lock(this);
    for (dxGeom *geom = first; geom; geom = geom->next)
    {
        if (IS_SPACE(geom))
            static_cast<dxSpace *>(geom)->cleanGeoms();
        geom->recomputeAABB();
        if (geom->gflags & GEOM_DIRTY)
            dirty(geom);
    }
}

void dxPredictiveSpace::catch_up()
{
    notice_unreported_moves();
    if (caught_up_)
        return;
    Lock lock(this);
    caught_up_ = true;
    GeomScene now = scene();
    broadphase_.catch_up(now);
}

void dxPredictiveSpace::catch_up_with_predictions()
{
    if (broadphase_.want_predictions())
        caught_up_ = false;
    catch_up();
}

void dxPredictiveSpace::collide(void *data, dNearCallback *callback)
{
    dAASSERT(callback);
    const bool nested_call = lock_count > 0;
    Lock lock(this);
    notice_unreported_moves();
    caught_up_ = true;
    GeomScene now = scene();
    if (nested_call)
        broadphase_.catch_up(now);
    else
    {
        ++ticks_;
        broadphase_.tick(now);
    }
    std::vector<CandidatePair> pairs = std::exchange(pairs_, {});
    const std::size_t count = broadphase_.report(now, pairs);
    const bool overflows_cache = geoms_.size() > cached_measured;
    for (std::size_t i = 0; i < count; ++i)
    {
        const CandidatePair pair = pairs[i];
        if (overflows_cache)
            prefetch_pair(pairs.data(), count, i);
        dxGeom *one = geoms_[pair.first], *other = geoms_[pair.second];
        if (bits_agree(one, other) && enabled(one) && enabled(other) && wants_callback(one, other))
        {
            ++reported_;
            callback(data, one, other);
        }
    }
    pairs_ = std::move(pairs);
}

// What the filters read of pairs that come after the i-th. Where the geoms are has to be fetched, too, and before them.
void dxPredictiveSpace::prefetch_pair(const CandidatePair *pairs, std::size_t count, std::size_t i) const
{
    constexpr std::size_t soon = 12;
    const CandidatePair &pair = later(pairs, count, i, soon), &farther = later(pairs, count, i, 2 * soon);
    prefetch(&geoms_[farther.first]);
    prefetch(&geoms_[farther.second]);
    prefetch_filters(geoms_[pair.first]);
    prefetch_filters(geoms_[pair.second]);
}

void dxPredictiveSpace::collide2(void *data, dxGeom *geom, dNearCallback *callback)
{
    dAASSERT(geom && callback);
    catch_up();
    index_when_asked_often();
    Lock lock(this);
    std::vector<ProxyId> found = std::exchange(found_, {});
    found.clear();
    find_near(geom, found);
    const GeomScene now = scene();
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        scene().prefetch(later(found, i, 4));
        dxGeom *other = geoms_[found[i]];
        if (bits_agree(other, geom) && enabled(other) && now.overlap(other, geom) && wants_callback(other, geom))
            callback(data, other, geom);
    }
    found_ = std::move(found);
}

// What is not predicted yet gets its predictions as time passes. For a program that only asks no time passes: each question
// would look at all of that. So many looks cost what the predictions do.
void dxPredictiveSpace::index_when_asked_often()
{
    constexpr int worth_predictions = 50;
    if (!broadphase_.scanning() || std::exchange(asked_at_, broadphase_.now()) != broadphase_.now())
        looks_at_all_ = 0;
    else if (++looks_at_all_ == worth_predictions)
    {
        broadphase_.predict_the_rest();
        caught_up_ = false;
        catch_up();
    }
}

// All geoms whose bounding box the geom's may overlap. By the measure of spheres, a ray is followed along its line; only
// those that it can touch from elsewhere are looked for in its box.
void dxPredictiveSpace::find_near(dxGeom *geom, std::vector<ProxyId> &found)
{
    geom->recomputeAABB();
    const bool as_line = geom->type == dRayClass && broadphase_.measure() == Proximity::sphere;
    const std::optional<RayProbe> line = as_line ? line_of_ray(geom) : std::nullopt;
    const FloatBox box = FloatBox::around(to_box(geom->aabb));
    if (!line)
    {
        broadphase_.query(box, [&](ProxyId id) { found.push_back(id); });
        return;
    }
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

void dxPredictiveSpace::set_proximity(Proximity measure)
{
    broadphase_.set_measure(measure);
    caught_up_ = false;
}

void dxPredictiveSpace::set_role(dxGeom *geom, Role role)
{
    broadphase_.set_role(proxy_of(geom), role);
    caught_up_ = false;
}

Role dxPredictiveSpace::role(dxGeom *geom) const
{
    return broadphase_.proxies().bounds[proxy_of(geom)].role;
}

void dxPredictiveSpace::set_deviation(int role, const Deviation *deviation)
{
    auto &fixed = broadphase_.predictor.deviation[static_cast<std::size_t>(role)];
    if (deviation)
        fixed = *deviation;
    else
        fixed.reset();
    broadphase_.predict_all_anew();
    caught_up_ = false;
}

void dxPredictiveSpace::set_horizon(HorizonBounds horizon)
{
    broadphase_.predictor.horizon = horizon;
    broadphase_.predict_all_anew();
    caught_up_ = false;
}

std::size_t dxPredictiveSpace::bytes() const
{
    return sizeof(*this) + broadphase_.bytes() + geoms_.capacity() * sizeof(void *) +
           found_.capacity() * sizeof(ProxyId) + pairs_.capacity() * sizeof(CandidatePair) + unclassified_.bytes() +
           polled_.bytes() + off_line_.bytes();
}
