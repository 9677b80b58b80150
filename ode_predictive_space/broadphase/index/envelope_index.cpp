#include "ode_predictive_space/broadphase/index/envelope_index.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ode_predictive_space
{
EnvelopeTree &EnvelopeIndex::tree(Shelf shelf)
{
    return shelf == Shelf::idle ? idle_ : shelf == Shelf::still ? still_ : moving_;
}

// Is it cheaper to deal with all objects than with the batch one by one? Building costs less than half of inserting one by
// one, and leaves a better tree.
bool EnvelopeIndex::is_bulk(const ProxyStore &proxies, std::size_t batch) const
{
    const std::size_t present = still_.size() + moving_.size() + idle_.size() + list_.size();
    return proxies.size() > tuning::small_scene && batch >= tuning::least_bulk && 2 * batch > present;
}

Shelf EnvelopeIndex::shelf_for(const ProxyStore &proxies, const IdSet &idle, const SweptProxy &swept) const
{
    const bool fits_tree = swept.box.bounded();
    if (fits_tree && idle.contains(swept.proxy))
        return Shelf::idle;
    if (!fits_tree || proxies.size() <= tuning::small_scene)
        return Shelf::list;
    return proxies.records[swept.proxy].kind.still ? Shelf::still : Shelf::moving;
}

// When the scene is not small any more.
void EnvelopeIndex::move_list_to_trees(ProxyStore &proxies, const IdSet &idle)
{
    const bool is_small = proxies.size() <= tuning::small_scene;
    if (!std::exchange(was_small_, is_small) || is_small)
        return;
    const BoxList list = std::exchange(list_, {});
    for (std::size_t i = 0; i < list.size(); ++i)
        put(proxies, list[i], shelf_for(proxies, idle, list[i]));
}

void EnvelopeIndex::update(ProxyStore &proxies, const std::vector<SweptProxy> &batch, const IdSet &in_batch,
                           const IdSet &idle, Tick now, std::size_t single, std::vector<CandidatePair> &pairs)
{
    move_list_to_trees(proxies, idle);
    if (is_bulk(proxies, batch.size()))
    {
        rebuild(proxies, batch, idle, now);
        sweep_pairs(proxies, in_batch, idle, pairs);
        return;
    }
    // First the pairs: the queries fetch the nodes beside which the batch is inserted.
    active_.clear();
    for (const SweptProxy &swept : batch)
        if (!idle.contains(swept.proxy))
            active_.push_back(swept);
    find_pairs(active_, in_batch, idle, pairs);
    still_.prefetch_for_update(batch);
    moving_.prefetch_for_update(batch);
    const auto part = batch.begin() + static_cast<std::ptrdiff_t>(std::min(single, batch.size()));
    for (auto swept = batch.begin(); swept != part; ++swept)
        update_place(proxies, *swept, shelf_for(proxies, idle, *swept));
    if (part != batch.end())
        graft(proxies, {part, batch.end()}, idle);
}

void EnvelopeIndex::update_place(ProxyStore &proxies, const SweptProxy &swept, Shelf shelf)
{
    ProxyRecord::Placement &placement = proxies.records[swept.proxy].placement;
    if (placement.shelf != shelf)
    {
        remove(proxies, swept.proxy);
        put(proxies, swept, shelf);
    }
    else if (shelf == Shelf::list)
    {
        list_.put(swept);
        placement.unbounded = !swept.box.bounded();
    }
    else
        tree(shelf).move(swept.proxy, swept.box);
}

void EnvelopeIndex::put(ProxyStore &proxies, const SweptProxy &swept, Shelf shelf)
{
    if (shelf == Shelf::list)
        list_.put(swept);
    else
        tree(shelf).insert(swept.proxy, swept.box);
    proxies.records[swept.proxy].placement = {shelf, !swept.box.bounded()};
}

void EnvelopeIndex::graft(ProxyStore &proxies, const std::vector<SweptProxy> &part, const IdSet &idle)
{
    std::vector<SweptProxy> still, moving;
    for (const SweptProxy &swept : part)
    {
        const Shelf shelf = shelf_for(proxies, idle, swept);
        if (shelf == Shelf::list || shelf == Shelf::idle)
        {
            update_place(proxies, swept, shelf);
            continue;
        }
        remove(proxies, swept.proxy);
        (shelf == Shelf::still ? still : moving).push_back(swept);
        proxies.records[swept.proxy].placement = {shelf, false};
    }
    still_.graft(still);
    moving_.graft(moving);
}

void EnvelopeIndex::rebuild(ProxyStore &proxies, const std::vector<SweptProxy> &batch, const IdSet &idle, Tick now)
{
    // Out of the list with the batch; the trees are replaced below.
    for (const SweptProxy &swept : batch)
        if (Shelf &shelf = proxies.records[swept.proxy].placement.shelf; shelf == Shelf::list)
            remove(proxies, swept.proxy);
        else
            shelf = Shelf::none;
    for (Shelf shelf : {Shelf::still, Shelf::moving, Shelf::idle})
    {
        std::vector<SweptProxy> leaves;
        for (ProxyId id = 0; id < proxies.size(); ++id)
            if (proxies.records[id].placement.shelf == shelf)
                leaves.push_back({id, proxies.swept_box(id, now)});
        for (const SweptProxy &swept : batch)
            if (shelf_for(proxies, idle, swept) == shelf)
                leaves.push_back(swept);
        tree(shelf).build(leaves);
        for (const SweptProxy &leaf : leaves)
            proxies.records[leaf.proxy].placement = {shelf, false};
    }
    for (const SweptProxy &swept : batch)
        if (proxies.records[swept.proxy].placement.shelf == Shelf::none)
            put(proxies, swept, Shelf::list);
}

void EnvelopeIndex::remove(ProxyStore &proxies, ProxyId id)
{
    Shelf &shelf = proxies.records[id].placement.shelf;
    if (shelf == Shelf::list)
        list_.remove(id);
    else if (shelf != Shelf::none)
        tree(shelf).remove(id);
    shelf = Shelf::none;
}

void EnvelopeIndex::clear(ProxyStore &proxies)
{
    for (EnvelopeTree *tree : {&still_, &moving_, &idle_})
        tree->clear();
    list_.clear();
    for (ProxyRecord &record : proxies.records)
        record.placement.shelf = Shelf::none;
}

// Objects of the batch are found in the index with their old boxes: those pairs are left out.
void EnvelopeIndex::find_pairs(const std::vector<SweptProxy> &batch, const IdSet &in_batch, const IdSet &idle,
                               std::vector<CandidatePair> &pairs)
{
    if (batch.size() > 1)
        sort_and_sweep_.find_pairs(batch, pairs);
    const bool has_trees = !still_.empty() || !moving_.empty();
    for (std::size_t i = 0; i < batch.size() && has_trees; i += EnvelopeTree::most_together)
        find_in_trees(batch.data() + i, std::min(batch.size() - i, EnvelopeTree::most_together), in_batch, pairs);
    for (const SweptProxy &swept : batch)
        list_.find(swept.box, [&](ProxyId other) {
            if (!in_batch.contains(other) && !idle.contains(other))
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
    // The pairs of one object come one after the other.
    std::size_t begin = pairs.size();
    for (std::size_t &end : ends)
        begin += std::exchange(end, begin);
    pairs.resize(begin);
    for (const EnvelopeTree::Hit &hit : hits_)
        pairs[ends[hit.probe]++] = {some[hit.probe].proxy, hit.proxy};
}

void EnvelopeIndex::sweep_pairs(const ProxyStore &proxies, const IdSet &in_batch, const IdSet &idle,
                                std::vector<CandidatePair> &pairs) const
{
    std::vector<SweptProxy> all;
    for (std::size_t i = 0; i < list_.size(); ++i)
        if (!idle.contains(list_[i].proxy))
            all.push_back(list_[i]);
    for (ProxyId id = 0; id < proxies.size(); ++id)
    {
        const Shelf shelf = proxies.records[id].placement.shelf;
        if (shelf == Shelf::still || shelf == Shelf::moving)
            all.push_back({id, shelf == Shelf::still ? still_.box(id) : moving_.box(id)});
    }
    SortAndSweep().find_pairs(all, pairs);
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const CandidatePair &pair) {
                                   return !in_batch.contains(pair.first) && !in_batch.contains(pair.second);
                               }),
                pairs.end());
}

std::size_t EnvelopeIndex::bytes() const
{
    return still_.bytes() + moving_.bytes() + idle_.bytes() + list_.bytes() + sort_and_sweep_.bytes() +
           bytes_of(active_) + bytes_of(probes_) + bytes_of(hits_);
}
} // namespace ode_predictive_space
