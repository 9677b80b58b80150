#include "ode_predictive_space/broadphase/index/envelope_index.h"

#include <algorithm>
#include <utility>

namespace ode_predictive_space
{
// For a batch this large, sweeping all objects costs less than querying for each and updating the index.
bool EnvelopeIndex::is_bulk(const ProxyStore &proxies, std::size_t batch) const
{
    return tuning::part_of_bulk * batch > proxies.count();
}

bool EnvelopeIndex::find_pairs(ProxyStore &proxies, const Batch &batch, const IdSet &idle,
                               std::vector<CandidatePair> &pairs)
{
    if (is_bulk(proxies, batch.size()))
    {
        sweep(proxies, batch, idle, pairs);
        return false;
    }
    prepare(proxies);
    boxes_.clear();
    for (ProxyId id : batch.ids())
        if (!idle.contains(id))
            boxes_.push_back({id, proxies.places[id].envelope()});
    query(batch, idle, pairs);
    return true;
}

void EnvelopeIndex::put(ProxyStore &proxies, const Batch &batch)
{
    const bool is_small = proxies.size() <= tuning::small_scene;
    is_stale_ |= is_small != std::exchange(is_small_, is_small) || is_bulk(proxies, batch.size());
    if (is_stale_)
        return;
    for (ProxyId id : batch.ids())
        put(proxies, id);
}

TreeKind EnvelopeIndex::tree_kind_for(const FloatBox &envelope) const
{
    return is_small_ || !envelope.bounded() ? TreeKind::list : TreeKind::tree;
}

void EnvelopeIndex::put(ProxyStore &proxies, ProxyId id)
{
    const SweptProxy swept{id, proxies.places[id].envelope()};
    TreeKind &tree_kind = proxies.records[id].tree_kind;
    const TreeKind wanted = tree_kind_for(swept.box);
    if (tree_kind != wanted)
        remove(proxies, id);
    if (wanted == TreeKind::list)
        list_.put(swept);
    else
        tree_kind == TreeKind::tree ? tree_.move(id, swept.box) : tree_.insert(id, swept.box);
    tree_kind = wanted;
}

void EnvelopeIndex::prepare(ProxyStore &proxies)
{
    if (!is_stale_)
        return;
    if (!refit(proxies))
        build(proxies);
    is_stale_ = false;
}

// Replaces each box in its place.
// @return false if an object belongs elsewhere or the tree has become much worse; then the index must be built.
bool EnvelopeIndex::refit(ProxyStore &proxies)
{
    bool are_all_there = true;
    boxes_.clear();
    proxies.members().for_each([&](ProxyId id) {
        const SweptProxy swept{id, proxies.places[id].envelope()};
        const TreeKind tree_kind = proxies.records[id].tree_kind;
        are_all_there &= tree_kind == tree_kind_for(swept.box);
        if (tree_kind == TreeKind::tree)
            boxes_.push_back(swept);
        else if (tree_kind == TreeKind::list)
            list_.put(swept);
    });
    return are_all_there && tree_.refit(boxes_);
}

void EnvelopeIndex::build(ProxyStore &proxies)
{
    clear(proxies); // tree_kind is set last, so that running out of memory leaves none set
    is_stale_ = true;
    boxes_.clear();
    proxies.members().for_each([&](ProxyId id) {
        const SweptProxy swept{id, proxies.places[id].envelope()};
        if (tree_kind_for(swept.box) == TreeKind::list)
            list_.add(swept);
        else
            boxes_.push_back(swept);
    });
    tree_.build(boxes_);
    proxies.members().for_each(
        [&](ProxyId id) { proxies.records[id].tree_kind = tree_kind_for(proxies.places[id].envelope()); });
}

void EnvelopeIndex::remove(ProxyStore &proxies, ProxyId id)
{
    TreeKind &tree_kind = proxies.records[id].tree_kind;
    if (tree_kind == TreeKind::list)
        list_.remove(id);
    else if (tree_kind == TreeKind::tree)
        tree_.remove(id);
    tree_kind = TreeKind::none;
}

void EnvelopeIndex::clear(ProxyStore &proxies)
{
    tree_.clear();
    list_.clear();
    is_stale_ = false;
    for (ProxyRecord &record : proxies.records)
        record.tree_kind = TreeKind::none;
}

// Tree and list skip objects of the batch, because sort and sweep finds the pairs within the batch.
void EnvelopeIndex::query(const Batch &batch, const IdSet &idle, std::vector<CandidatePair> &pairs)
{
    if (boxes_.size() > 1)
        sort_and_sweep_.find_pairs(boxes_, pairs);
    for (std::size_t i = 0; i < boxes_.size() && !tree_.empty(); i += EnvelopeTree::most_together)
        find_in_tree(boxes_.data() + i, std::min(boxes_.size() - i, EnvelopeTree::most_together), batch, idle, pairs);
    for (const SweptProxy &swept : boxes_)
        list_.walk(BoxProbe(swept.box), [&](ProxyId other) {
            if (!batch.contains(other) && !idle.contains(other))
                pairs.push_back({swept.proxy, other});
        });
}

void EnvelopeIndex::find_in_tree(const SweptProxy *some, std::size_t count, const Batch &batch, const IdSet &idle,
                                 std::vector<CandidatePair> &pairs)
{
    probes_.clear();
    for (std::size_t i = 0; i < count; ++i)
        probes_.emplace_back(some[i].box);
    tree_.walk_together(probes_.data(), count, [&](std::uint32_t i, ProxyId other) {
        if (!batch.contains(other) && !idle.contains(other))
            pairs.push_back({some[i].proxy, other});
    });
}

void EnvelopeIndex::sweep(const ProxyStore &proxies, const Batch &batch, const IdSet &idle,
                          std::vector<CandidatePair> &pairs)
{
    boxes_.clear();
    proxies.members().for_each([&](ProxyId id) {
        if (!idle.contains(id))
            boxes_.push_back({id, proxies.places[id].envelope()});
    });
    const std::size_t before = pairs.size();
    sort_and_sweep_.find_pairs(boxes_, pairs);
    if (batch.size() == proxies.count())
        return;
    pairs.erase(std::remove_if(pairs.begin() + static_cast<std::ptrdiff_t>(before), pairs.end(),
                               [&](const CandidatePair &pair) {
                                   return !batch.contains(pair.first) && !batch.contains(pair.second);
                               }),
                pairs.end());
}

std::size_t EnvelopeIndex::bytes() const
{
    return tree_.bytes() + list_.bytes() + sort_and_sweep_.bytes() + bytes_of(boxes_) + bytes_of(probes_);
}
} // namespace ode_predictive_space
