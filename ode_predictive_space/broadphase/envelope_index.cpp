#include "ode_predictive_space/broadphase/envelope_index.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ode_predictive_space
{
// Is it cheaper to deal with all than with these one by one?
bool EnvelopeIndex::is_bulk(const ProxyStore &proxies, std::size_t batch) const
{
    const std::size_t present = still_.size() + moving_.size() + list_.size();
    return proxies.size() > small_scene && batch >= 16 && 2 * batch > present;
}

Shelf EnvelopeIndex::shelf_for(const ProxyStore &proxies, const SweptProxy &swept) const
{
    if (proxies.size() <= small_scene || !swept.box.bounded())
        return Shelf::list;
    return proxies.bounds[swept.proxy].still ? Shelf::still : Shelf::moving;
}

// Moves what a tree can hold there when the scene is not small any more.
void EnvelopeIndex::outgrow_list(ProxyStore &proxies)
{
    const bool is_small = proxies.size() <= small_scene;
    if (std::exchange(was_small_, is_small) && !is_small)
    {
        const BoxList list = std::exchange(list_, {});
        for (std::size_t i = 0; i < list.size(); ++i)
            put(proxies, list[i]);
    }
}

void EnvelopeIndex::update(ProxyStore &proxies, const std::vector<SweptProxy> &batch, const IdSet &in_batch, Tick now,
                           std::size_t single, std::vector<CandidatePair> &pairs)
{
    outgrow_list(proxies);
    // Building costs less than half of inserting one by one, and leaves a better tree.
    if (is_bulk(proxies, batch.size()))
    {
        rebuild(proxies, batch, now);
        sweep_pairs(proxies, in_batch, pairs);
        return;
    }
    // First the pairs: the nodes that this looks at are those that the batch is put beside.
    find_pairs(batch, in_batch, pairs);
    still_.foresee(batch);
    moving_.foresee(batch);
    const auto part = batch.begin() + static_cast<std::ptrdiff_t>(std::min(single, batch.size()));
    for (auto swept = batch.begin(); swept != part; ++swept)
        put_anew(proxies, *swept);
    if (part != batch.end())
        graft(proxies, {part, batch.end()});
}

void EnvelopeIndex::put_anew(ProxyStore &proxies, const SweptProxy &swept)
{
    const Shelf shelf = proxies.bounds[swept.proxy].shelf;
    if (shelf == Shelf::none || shelf != shelf_for(proxies, swept))
    {
        remove(proxies, swept.proxy);
        put(proxies, swept);
    }
    else if (shelf == Shelf::list)
    {
        list_.put(swept);
        proxies.bounds[swept.proxy].unbounded = !swept.box.bounded();
    }
    else
        tree(shelf).move(swept.proxy, swept.box);
}

void EnvelopeIndex::graft(ProxyStore &proxies, const std::vector<SweptProxy> &part)
{
    std::vector<SweptProxy> still, moving;
    for (const SweptProxy &swept : part)
    {
        const Shelf shelf = shelf_for(proxies, swept);
        if (shelf == Shelf::list)
        {
            put_anew(proxies, swept);
            continue;
        }
        remove(proxies, swept.proxy);
        (shelf == Shelf::still ? still : moving).push_back(swept);
        proxies.bounds[swept.proxy].shelf = shelf;
        proxies.bounds[swept.proxy].unbounded = false;
    }
    still_.graft(still);
    moving_.graft(moving);
}

void EnvelopeIndex::put(ProxyStore &proxies, const SweptProxy &swept)
{
    const Shelf shelf = shelf_for(proxies, swept);
    if (shelf == Shelf::list)
        list_.put(swept);
    else
        tree(shelf).insert(swept.proxy, swept.box);
    proxies.bounds[swept.proxy].shelf = shelf;
    proxies.bounds[swept.proxy].unbounded = !swept.box.bounded();
}

void EnvelopeIndex::rebuild(ProxyStore &proxies, const std::vector<SweptProxy> &batch, Tick now)
{
    // Off the shelves with the batch; the trees themselves are thrown away below.
    for (const SweptProxy &swept : batch)
        if (proxies.bounds[swept.proxy].shelf == Shelf::list)
            remove(proxies, swept.proxy);
        else
            proxies.bounds[swept.proxy].shelf = Shelf::none;
    for (Shelf shelf : {Shelf::still, Shelf::moving})
    {
        std::vector<SweptProxy> leaves;
        for (ProxyId id = 0; id < proxies.size(); ++id)
            if (proxies.bounds[id].shelf == shelf)
                leaves.push_back({id, proxies.swept_box(id, now)});
        for (const SweptProxy &swept : batch)
            if (shelf_for(proxies, swept) == shelf)
                leaves.push_back(swept);
        tree(shelf).build(leaves);
        for (const SweptProxy &leaf : leaves)
        {
            proxies.bounds[leaf.proxy].shelf = shelf;
            proxies.bounds[leaf.proxy].unbounded = false;
        }
    }
    for (const SweptProxy &swept : batch)
        if (proxies.bounds[swept.proxy].shelf == Shelf::none)
            put(proxies, swept);
}

void EnvelopeIndex::remove(ProxyStore &proxies, ProxyId id)
{
    Shelf &shelf = proxies.bounds[id].shelf;
    if (shelf == Shelf::list)
        list_.remove(id);
    else if (shelf != Shelf::none)
        tree(shelf).remove(id);
    shelf = Shelf::none;
}

void EnvelopeIndex::clear(ProxyStore &proxies)
{
    if (empty())
        return;
    still_.build({});
    moving_.build({});
    list_.clear();
    for (PackedBounds &bounds : proxies.bounds)
        bounds.shelf = Shelf::none;
}

void EnvelopeIndex::find_pairs(const std::vector<SweptProxy> &batch, const IdSet &in_batch,
                               std::vector<CandidatePair> &pairs)
{
    if (batch.size() > 1)
        sweep_.find_pairs(batch, pairs);
    // With the others: where those of the batch are in the index, they are as they were before.
    for (std::size_t i = 0; i < batch.size() && has_trees(); i += EnvelopeTree::most_together)
        find_in_trees(batch.data() + i, std::min(batch.size() - i, EnvelopeTree::most_together), in_batch, pairs);
    for (const SweptProxy &swept : batch)
        find_in_list(swept, in_batch, pairs);
}

void EnvelopeIndex::find_in_list(const SweptProxy &swept, const IdSet &in_batch, std::vector<CandidatePair> &pairs)
{
    list_.find(swept.box, [&](ProxyId other) {
        if (!in_batch.contains(other))
            pairs.push_back({swept.proxy, other});
    });
}

void EnvelopeIndex::find_in_trees(const SweptProxy *some, std::size_t count, const IdSet &in_batch,
                                  std::vector<CandidatePair> &pairs)
{
    probes_.clear();
    for (std::size_t i = 0; i < count; ++i)
        probes_.emplace_back(some[i].box);
    hits_.clear();
    std::array<std::size_t, EnvelopeTree::most_together> ends{};
    const auto visit = [&](std::uint32_t i, ProxyId other) {
        if (in_batch.contains(other))
            return;
        hits_.push_back({i, other});
        ++ends[i];
    };
    still_.walk_together(probes_.data(), count, visit);
    moving_.walk_together(probes_.data(), count, visit);
    // One object after the other.
    std::size_t begin = pairs.size();
    for (std::size_t &end : ends)
        begin += std::exchange(end, begin);
    pairs.resize(begin);
    for (const EnvelopeTree::Hit &hit : hits_)
        pairs[ends[hit.probe]++] = {some[hit.probe].proxy, hit.proxy};
}

void EnvelopeIndex::sweep_pairs(const ProxyStore &proxies, const IdSet &in_batch,
                                std::vector<CandidatePair> &pairs) const
{
    std::vector<SweptProxy> all;
    for (std::size_t i = 0; i < list_.size(); ++i)
        all.push_back(list_[i]);
    for (ProxyId id = 0; id < proxies.size(); ++id)
    {
        const Shelf shelf = proxies.bounds[id].shelf;
        if (shelf == Shelf::still || shelf == Shelf::moving)
            all.push_back({id, shelf == Shelf::still ? still_.box(id) : moving_.box(id)});
    }
    Sweep().find_pairs(all, pairs);
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const CandidatePair &pair) {
                                   return !in_batch.contains(pair.first) && !in_batch.contains(pair.second);
                               }),
                pairs.end());
}

std::size_t EnvelopeIndex::bytes() const
{
    return still_.bytes() + moving_.bytes() + list_.bytes() + sweep_.bytes() +
           hits_.capacity() * sizeof(EnvelopeTree::Hit) + probes_.capacity() * sizeof(BoxProbe);
}
} // namespace ode_predictive_space
