// The index of all envelopes. In: objects with new envelopes. Out: their overlapping pairs, each once; and answers to queries.
// A tree holds the envelopes. A list holds those that no tree can hold, and all of a small scene.

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
    /// Appends all pairs of overlapping envelopes with at least one object in the batch and none idle, each once. A large batch
    /// is swept together with all other objects; a small one queries the index.
    /// @return false if all were swept.
    bool find_pairs(ProxyStore &proxies, const Batch &batch, const IdSet &idle, std::vector<CandidatePair> &pairs);

    /// Stores the batch's new envelopes. After a large batch the index is stale until prepare().
    void put(ProxyStore &proxies, const Batch &batch);

    void prepare(ProxyStore &proxies);
    bool is_prepared() const { return !is_stale_; }

    void remove(ProxyStore &proxies, ProxyId id);

    void clear(ProxyStore &proxies);

    /// Calls visit(id) for each object whose envelope the probe overlaps, idle ones included; see EnvelopeTree::walk().
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
    void query(const Batch &batch, const IdSet &idle, std::vector<CandidatePair> &pairs);
    void find_in_tree(const SweptProxy *some, std::size_t count, const Batch &batch, const IdSet &idle,
                      std::vector<CandidatePair> &pairs);
    void sweep(const ProxyStore &proxies, const Batch &batch, const IdSet &idle, std::vector<CandidatePair> &pairs);

    EnvelopeTree tree_;
    BoxList list_;
    bool is_small_ = true;  // the list holds all envelopes
    bool is_stale_ = false; // it must be refitted or built before walk()
    SortAndSweep sort_and_sweep_;
    std::vector<SweptProxy> boxes_; // scratch
    std::vector<BoxProbe> probes_;  // scratch
};
} // namespace ode_predictive_space

#endif
