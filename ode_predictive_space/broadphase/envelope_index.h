// Which envelopes can meet: still and moving ones in trees of their own, unbounded ones in a list.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_ENVELOPE_INDEX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_ENVELOPE_INDEX_H

#include <vector>

#include "ode_predictive_space/broadphase/envelope_tree.h"
#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/proxy_store.h"

namespace ode_predictive_space
{
class EnvelopeIndex
{
public:
    /// Puts a predicted proxy on the shelf where its envelope belongs and notes that in proxies.bounds[id].shelf.
    void update(ProxyStore &proxies, ProxyId id, Tick now);

    /// The same for many proxies at once.
    void update(ProxyStore &proxies, const std::vector<ProxyId> &batch, Tick now);

    /// Takes a proxy off its shelf, if it is on one.
    void remove(ProxyStore &proxies, ProxyId id);

    /// Takes all proxies off their shelves.
    void clear(ProxyStore &proxies);

    /// Calls visit(id) for every proxy whose envelope may overlap `box`.
    template <typename Visit> void query(const FloatBox &box, Visit visit) const
    {
        still_.query(box, visit);
        moving_.query(box, visit);
        for (const EnvelopeTree::Leaf &leaf : unbounded_)
            if (leaf.box.overlaps(box))
                visit(leaf.proxy);
    }

    /// Finds all pairs of which at least one is in the batch and whose envelopes may overlap, each once.
    ///
    /// @param in_batch the batch as a set.
    void find_pairs(const ProxyStore &proxies, const std::vector<ProxyId> &batch, const IdSet &in_batch, Tick now,
                    std::vector<CandidatePair> &pairs) const;

    bool consistent() const { return still_.consistent() && moving_.consistent(); }
    std::size_t bytes() const;

private:
    EnvelopeTree &tree(Shelf shelf) { return shelf == Shelf::still ? still_ : moving_; }
    void rebuild(ProxyStore &proxies, Tick now);

    EnvelopeTree still_;
    EnvelopeTree moving_;
    std::vector<EnvelopeTree::Leaf> unbounded_;
    std::vector<EnvelopeTree::Leaf> leaves_; // scratch of rebuild()
};
} // namespace ode_predictive_space

#endif
