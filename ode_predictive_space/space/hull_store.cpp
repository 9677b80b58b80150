#include "ode_predictive_space/space/hull_store.h"

namespace ode_predictive_space
{
HullStore::Found HullStore::hull_of(ProxyId id, dxGeom *geom, std::size_t &steps)
{
    OfGeom &own = geoms_[id];
    if (own.hull && !is_outdated(geom, *own.hull))
        return {own.hull};
    const DataKey key = key_of(geom);
    own.hull = known(key);
    if (own.hull || key == DataKey{})
        return {own.hull};
    if (steps == 0 && !(own.maker && own.maker->is_done()))
        return {nullptr, true};
    std::unique_ptr<HullMaker> maker = std::move(own.maker); // if memory runs out, the maker is lost with its work
    if (!maker || maker->key() != key)
        maker = std::make_unique<HullMaker>(geom, key);
    steps = maker->go_on(steps);
    const bool is_done = maker->is_done();
    if (is_done && maker->hull())
    {
        add(maker->hull());
        own.hull = maker->hull();
    }
    else
        own.maker = std::move(maker);
    return {own.hull, !is_done};
}

std::shared_ptr<const DataHull> HullStore::known(const DataKey &key) const
{
    const auto known = hulls_.find(key);
    const std::shared_ptr<const DataHull> hull = known == hulls_.end() ? nullptr : known->second.lock();
    return hull && !hull->outdated ? hull : nullptr;
}

// Removes unused hulls whenever the number of hulls has doubled.
void HullStore::add(const std::shared_ptr<DataHull> &hull)
{
    if (hulls_.size() >= 2 * used_)
    {
        for (auto old = hulls_.begin(); old != hulls_.end();)
            old = old->second.expired() ? hulls_.erase(old) : std::next(old);
        used_ = hulls_.size() + 1;
    }
    hull->number = ++made_;
    hulls_[hull->key] = hull;
}

bool HullStore::is_outdated(dxGeom *geom, const VertexHull &hull)
{
    const DataHull &made = static_cast<const DataHull &>(hull);
    return made.outdated || made.key != key_of(geom);
}

// Includes hulls of other data that are read from the same array.
void HullStore::outdate(dxGeom *geom)
{
    const std::uint64_t array = key_of(geom).front();
    for (auto known = hulls_.lower_bound(DataKey{array}); known != hulls_.end() && known->first.front() == array;)
    {
        if (const std::shared_ptr<DataHull> hull = known->second.lock())
            hull->outdated = true;
        known = hulls_.erase(known);
    }
    for (auto &[id, own] : geoms_)
        if (own.maker && own.maker->key().front() == array)
            own.maker.reset();
}

std::size_t HullStore::bytes() const
{
    std::size_t bytes = 0;
    for (const auto &[key, known] : hulls_)
    {
        const std::shared_ptr<DataHull> hull = known.lock();
        bytes += sizeof key + sizeof known + (hull ? hull->bytes() : 0);
    }
    for (const auto &[id, own] : geoms_)
        bytes += sizeof id + sizeof own + (own.maker ? own.maker->bytes() : 0);
    return bytes;
}
} // namespace ode_predictive_space
