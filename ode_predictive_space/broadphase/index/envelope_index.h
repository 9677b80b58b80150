// Third stage of the tick, first half: which envelopes can meet?
//
// In: the batch with its swept boxes. Out: candidate pairs, each once, and an index that is up to date. Still and moving
// envelopes are in trees of their own; boxes that no tree can hold are in a list, as all boxes of a small scene are.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_ENVELOPE_INDEX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_ENVELOPE_INDEX_H

#include <vector>

#include "ode_predictive_space/broadphase/index/box_list.h"
#include "ode_predictive_space/broadphase/index/envelope_tree.h"
#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"
#include "ode_predictive_space/broadphase/objects/proxy_store.h"

namespace ode_predictive_space
{
class EnvelopeIndex
{
public:
    /// Puts newly predicted objects, given with their swept boxes, where their envelopes belong. Appends to `pairs` all pairs
    /// of which at least one is in the batch, none is idle, and whose envelopes may overlap, each once.
    ///
    /// @param in_batch the batch as a set.
    /// @param idle objects for which no pairs are wanted.
    /// @param single the first so many of the batch lie anywhere. Those behind them are neighbours: they become a part of a
    ///     tree that is built at once, which takes a quarter of the time.
    void update(ProxyStore &proxies, const std::vector<SweptProxy> &batch, const IdSet &in_batch, const IdSet &idle,
                Tick now, std::size_t single, std::vector<CandidatePair> &pairs);

    /// Builds the trees anew, with the batch in its places: inserting one by one leaves a worse tree.
    void rebuild(ProxyStore &proxies, const std::vector<SweptProxy> &batch, const IdSet &idle, Tick now);

    /// Removes an object, if it is in the index.
    void remove(ProxyStore &proxies, ProxyId id);

    /// Removes all objects.
    void clear(ProxyStore &proxies);

    /// Calls visit(id) for every object whose envelope may overlap `box`, idle ones among them.
    template <typename Visit> void query(const FloatBox &box, Visit visit) const { walk(BoxProbe(box), visit); }

    /// The same for a probe of any shape; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        still_.walk(probe, visit);
        moving_.walk(probe, visit);
        idle_.walk(probe, visit);
        list_.walk(probe, visit);
    }

    bool empty() const { return still_.empty() && moving_.empty() && idle_.empty() && list_.empty(); }
    bool consistent() const { return still_.consistent() && moving_.consistent() && idle_.consistent(); }
    std::size_t bytes() const;

private:
    bool is_bulk(const ProxyStore &proxies, std::size_t batch) const;
    Shelf shelf_for(const ProxyStore &proxies, const IdSet &idle, const SweptProxy &swept) const;
    EnvelopeTree &tree(Shelf shelf);
    void move_list_to_trees(ProxyStore &proxies, const IdSet &idle);
    void put(ProxyStore &proxies, const SweptProxy &swept, Shelf shelf);
    void update_place(ProxyStore &proxies, const SweptProxy &swept, Shelf shelf);
    void graft(ProxyStore &proxies, const std::vector<SweptProxy> &part, const IdSet &idle);

    void find_pairs(const std::vector<SweptProxy> &batch, const IdSet &in_batch, const IdSet &idle,
                    std::vector<CandidatePair> &pairs);
    void find_in_trees(const SweptProxy *some, std::size_t count, const IdSet &in_batch,
                       std::vector<CandidatePair> &pairs);
    void sweep_pairs(const ProxyStore &proxies, const IdSet &in_batch, const IdSet &idle,
                     std::vector<CandidatePair> &pairs) const;

    EnvelopeTree still_, moving_, idle_;
    BoxList list_;
    SortAndSweep sort_and_sweep_;    // of a batch
    std::vector<SweptProxy> active_; // scratch, as the next two: the batch without idle objects
    std::vector<BoxProbe> probes_;
    std::vector<EnvelopeTree::Hit> hits_;
    bool was_small_ = false; // the list holds what trees can hold
};
} // namespace ode_predictive_space

#endif
