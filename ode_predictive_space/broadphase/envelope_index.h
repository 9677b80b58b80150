// Which envelopes can meet: still and moving ones in trees of their own, unbounded ones in a list, and all in that list
// while they are few.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_ENVELOPE_INDEX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_ENVELOPE_INDEX_H

#include <vector>

#include "ode_predictive_space/broadphase/box_list.h"
#include "ode_predictive_space/broadphase/envelope_tree.h"
#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/proxy_store.h"
#include "ode_predictive_space/broadphase/sweep.h"

namespace ode_predictive_space
{
class EnvelopeIndex
{
public:
    /// So many are looked through quicker than any tree.
    static constexpr std::size_t small_scene = 128;

    /// Puts newly predicted proxies, given with their swept boxes, on the shelves where their envelopes belong, and notes
    /// that in proxies.bounds[id].shelf. Appends to `pairs` all pairs of which at least one is in the batch and whose
    /// envelopes may overlap, each once.
    ///
    /// @param in_batch the batch as a set.
    /// @param single so many at the beginning of the batch lie anywhere. Those behind them lie side by side: they become a
    ///     part of a tree that is built at once, which takes a quarter of the time.
    void update(ProxyStore &proxies, const std::vector<SweptProxy> &batch, const IdSet &in_batch, Tick now,
                std::size_t single, std::vector<CandidatePair> &pairs);

    /// Builds the trees anew, with the batch in its places: inserting one after another leaves a worse tree.
    void rebuild(ProxyStore &proxies, const std::vector<SweptProxy> &batch, Tick now);

    /// Takes a proxy off its shelf, if it is on one.
    void remove(ProxyStore &proxies, ProxyId id);

    /// Takes all proxies off their shelves.
    void clear(ProxyStore &proxies);

    /// Calls visit(id) for every proxy whose envelope may overlap `box`.
    template <typename Visit> void query(const FloatBox &box, Visit visit) const { walk(BoxProbe(box), visit); }

    /// The same for a probe of any shape; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        still_.walk(probe, visit);
        moving_.walk(probe, visit);
        list_.walk(probe, visit);
    }

    bool empty() const { return still_.empty() && moving_.empty() && list_.empty(); }
    bool consistent() const { return still_.consistent() && moving_.consistent(); }
    std::size_t bytes() const;

private:
    bool is_bulk(const ProxyStore &proxies, std::size_t batch) const;
    Shelf shelf_for(const ProxyStore &proxies, const SweptProxy &swept) const;
    void outgrow_list(ProxyStore &proxies);
    void put_anew(ProxyStore &proxies, const SweptProxy &swept);
    void graft(ProxyStore &proxies, const std::vector<SweptProxy> &part);
    EnvelopeTree &tree(Shelf shelf) { return shelf == Shelf::still ? still_ : moving_; }
    void put(ProxyStore &proxies, const SweptProxy &swept);

    void find_pairs(const std::vector<SweptProxy> &batch, const IdSet &in_batch, std::vector<CandidatePair> &pairs);
    void find_in_list(const SweptProxy &swept, const IdSet &in_batch, std::vector<CandidatePair> &pairs);
    bool has_trees() const { return !still_.empty() || !moving_.empty(); }
    void find_in_trees(const SweptProxy *some, std::size_t count, const IdSet &in_batch,
                       std::vector<CandidatePair> &pairs);
    void sweep_pairs(const ProxyStore &proxies, const IdSet &in_batch, std::vector<CandidatePair> &pairs) const;

    EnvelopeTree still_;
    EnvelopeTree moving_;
    BoxList list_;
    Sweep sweep_;
    std::vector<BoxProbe> probes_; // scratch, as the next one
    std::vector<EnvelopeTree::Hit> hits_;
    bool was_small_ = false; // so that what a tree can hold is in the list
};
} // namespace ode_predictive_space

#endif
