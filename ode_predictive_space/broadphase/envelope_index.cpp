#include "ode_predictive_space/broadphase/envelope_index.h"

#include <algorithm>

namespace ode_predictive_space
{
namespace
{
Shelf shelf_for(const PackedBounds &bounds, const FloatBox &box)
{
    if (!box.bounded())
        return Shelf::unbounded;
    return bounds.still ? Shelf::still : Shelf::moving;
}
} // namespace

void EnvelopeIndex::update(ProxyStore &proxies, ProxyId id, Tick now)
{
    remove(proxies, id);
    const FloatBox box = proxies.swept_box(id, now);
    const Shelf shelf = shelf_for(proxies.bounds[id], box);
    if (shelf == Shelf::unbounded)
        unbounded_.push_back({id, box});
    else
        tree(shelf).insert(id, box);
    proxies.bounds[id].shelf = shelf;
}

void EnvelopeIndex::update(ProxyStore &proxies, const std::vector<ProxyId> &batch, Tick now)
{
    // Building costs about a quarter of inserting one by one, and leaves a better tree.
    if (batch.size() >= 16 && 4 * batch.size() >= proxies.size())
    {
        for (ProxyId id : batch)
            if (proxies.bounds[id].shelf == Shelf::unbounded)
                remove(proxies, id);
            else
                proxies.bounds[id].shelf = Shelf::none;
        for (ProxyId id : batch)
        {
            const FloatBox box = proxies.swept_box(id, now);
            proxies.bounds[id].shelf = shelf_for(proxies.bounds[id], box);
            if (proxies.bounds[id].shelf == Shelf::unbounded)
                unbounded_.push_back({id, box});
        }
        rebuild(proxies, now);
        return;
    }
    for (ProxyId id : batch)
        update(proxies, id, now);
}

void EnvelopeIndex::rebuild(ProxyStore &proxies, Tick now)
{
    for (Shelf shelf : {Shelf::still, Shelf::moving})
    {
        leaves_.clear();
        for (ProxyId id = 0; id < proxies.size(); ++id)
            if (proxies.bounds[id].shelf == shelf)
                leaves_.push_back({id, proxies.swept_box(id, now)});
        tree(shelf).build(leaves_);
    }
}

void EnvelopeIndex::remove(ProxyStore &proxies, ProxyId id)
{
    Shelf &shelf = proxies.bounds[id].shelf;
    if (shelf == Shelf::unbounded)
        unbounded_.erase(std::find_if(unbounded_.begin(), unbounded_.end(),
                                      [id](const EnvelopeTree::Leaf &leaf) { return leaf.proxy == id; }));
    else if (shelf != Shelf::none)
        tree(shelf).remove(id);
    shelf = Shelf::none;
}

void EnvelopeIndex::clear(ProxyStore &proxies)
{
    leaves_.clear();
    still_.build(leaves_);
    moving_.build(leaves_);
    unbounded_.clear();
    for (PackedBounds &bounds : proxies.bounds)
        bounds.shelf = Shelf::none;
}

void EnvelopeIndex::find_pairs(const ProxyStore &proxies, const std::vector<ProxyId> &batch, const IdSet &in_batch,
                               Tick now, std::vector<CandidatePair> &pairs) const
{
    for (ProxyId id : batch)
        query(proxies.swept_box(id, now), [&](ProxyId other) {
            // Two of the batch find each other twice.
            if (other != id && (other > id || !in_batch.contains(other)))
                pairs.push_back({id, other});
        });
}

std::size_t EnvelopeIndex::bytes() const
{
    return still_.bytes() + moving_.bytes() + (unbounded_.capacity() + leaves_.capacity()) * sizeof(EnvelopeTree::Leaf);
}
} // namespace ode_predictive_space
