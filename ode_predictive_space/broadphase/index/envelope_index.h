// Which envelopes can meet? In: objects with new envelopes. Out: the pairs of them, each once, and an index for questions.
//
// Envelopes are in a tree; those that no tree can hold are in a list, as all envelopes of a small scene are.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_ENVELOPE_INDEX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_ENVELOPE_INDEX_H

#include <vector>

#include "ode_predictive_space/broadphase/base/batch.h"
#include "ode_predictive_space/broadphase/index/box_list.h"
#include "ode_predictive_space/broadphase/index/envelope_tree.h"
#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"
#include "ode_predictive_space/broadphase/objects/proxy_store.h"

namespace ode_predictive_space
{
class EnvelopeIndex
{
public:
    /// Appends to `pairs` all pairs of which at least one is in the batch, none is idle, and whose envelopes overlap, each once.
    /// Many new envelopes are swept together with all others; few are looked up.
    ///
    /// @param idle objects for which no pairs are wanted.
    /// @return false when all were swept.
    bool find_pairs(ProxyStore &proxies, const Batch &batch, const IdSet &idle, std::vector<CandidatePair> &pairs);

    /// The objects have new envelopes. When they are many, the index is out of date until prepare().
    void put(ProxyStore &proxies, const Batch &batch);

    /// Brings the index up to date.
    void prepare(ProxyStore &proxies);
    /// May walk() be called?
    bool is_prepared() const { return !is_stale_; }

    /// Removes an object, if it is in the index.
    void remove(ProxyStore &proxies, ProxyId id);

    /// Removes all objects.
    void clear(ProxyStore &proxies);

    /// Calls visit(id) for every object whose envelope the probe overlaps, idle ones among them; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        tree_.walk(probe, visit);
        list_.walk(probe, visit);
    }

    bool consistent() const { return is_stale_ || tree_.consistent(); }
    std::size_t bytes() const;

private:
    bool is_bulk(const ProxyStore &proxies, std::size_t batch) const;
    void put(ProxyStore &proxies, ProxyId id);
    bool refit(ProxyStore &proxies);
    void build(ProxyStore &proxies);
    TreeKind tree_kind_for(const FloatBox &envelope) const;
    void look_up(const Batch &batch, const IdSet &idle, std::vector<CandidatePair> &pairs);
    void find_in_tree(const SweptProxy *some, std::size_t count, const Batch &batch, const IdSet &idle,
                      std::vector<CandidatePair> &pairs);
    void sweep(const ProxyStore &proxies, const Batch &batch, const IdSet &idle, std::vector<CandidatePair> &pairs);

    EnvelopeTree tree_;
    BoxList list_;
    bool is_small_ = true;  // the list holds what trees can hold
    bool is_stale_ = false; // envelopes are not where they belong
    SortAndSweep sort_and_sweep_;
    std::vector<SweptProxy> boxes_; // scratch, as the others
    std::vector<BoxProbe> probes_;
};
} // namespace ode_predictive_space

#endif
