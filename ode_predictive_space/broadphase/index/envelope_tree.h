// A dynamic tree of boxes: which envelopes can meet a given one? Many queries go down together, and a large change rebuilds the
// whole tree.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_ENVELOPE_TREE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_ENVELOPE_TREE_H

#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/base/float_box.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/base/prefetch.h"

namespace ode_predictive_space
{
/// A binary tree of bounded boxes with an object in each leaf.
///
/// Siblings are stored side by side (nodes 2k and 2k + 1), so that a visit of both touches one cache line; node 0 is the
/// root and node 1 unused. Leaves are inserted where they enlarge the tree least, and rotations keep it shallow.
class EnvelopeTree
{
public:
    /// Adds a proxy that is not in the tree. The box must be bounded().
    void insert(ProxyId proxy, const FloatBox &box);

    /// Removes a proxy that is in the tree.
    void remove(ProxyId proxy) { take_out(proxy); }

    /// Gives a proxy that is in the tree another box: the same as remove() and insert(), but quicker when the box is near
    /// the old one, because the search begins there.
    void move(ProxyId proxy, const FloatBox &box);

    /// Removes all proxies.
    void clear();

    /// Replaces the whole tree by one over these leaves, built from the top: for when many boxes change at once.
    void build(const std::vector<SweptProxy> &leaves);

    bool empty() const { return nodes_.empty(); }

    /// Proxies in it.
    std::size_t size() const { return nodes_.size() / 2 - free_pairs_.size(); }

    /// Calls visit(proxy) for every proxy whose box overlaps `box`.
    template <typename Visit> void query(const FloatBox &box, Visit visit) const { walk(BoxProbe(box), visit); }

    /// Calls visit(proxy) for every proxy whose box overlaps the probe, which has any shape and a function
    /// `bool overlaps(const FloatBox &) const`. The function is called for the boxes of whole branches, too, and must be true
    /// for a box that holds a box which it overlaps.
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        if (nodes_.empty() || !probe.overlaps(nodes_[0].box))
            return;
        nodes_[0].leaf() ? visit(nodes_[0].proxy()) : walk_below(nodes_[0].content, probe, visit);
    }

    /// The same for several probes at once, which is faster where nodes are not in the cache: no probe waits for another's.
    ///
    /// @param count at most most_together.
    /// @param visit called as visit(i, proxy) for what the i-th probe overlaps; not in the order of the probes.
    template <typename Probe, typename Visit>
    void walk_together(const Probe *probes, std::size_t count, Visit visit) const;
    static constexpr std::size_t most_together = tuning::queries_together;

    /// The box stored for a proxy that is in the tree.
    const FloatBox &box(ProxyId proxy) const { return nodes_[leaf_node_[proxy]].box; }

    /// Checks links and boxes.
    bool consistent() const;

    /// Nodes on the longest way from the root to a leaf.
    int depth() const { return nodes_.empty() ? 0 : depth(0); }

    std::size_t bytes() const;

private:
    using Index = std::int32_t;
    static constexpr Index none = -1;
    static constexpr std::size_t walk_room = 256;
    static_assert(most_together <= walk_room, "all probes begin in there");

    /// A node that the probe of this number overlaps.
    struct Step
    {
        Index content;
        std::uint32_t probe;
    };

    struct Node
    {
        FloatBox box;
        Index parent;
        Index content; // >= 0: first of its two children; < 0: ~proxy of a leaf
        bool leaf() const { return content < 0; }
        ProxyId proxy() const { return static_cast<ProxyId>(~content); }
    };
    static_assert(sizeof(Node) == 32, "two siblings share a cache line");

    template <typename Probe, typename Visit> void walk_below(Index pair, const Probe &probe, const Visit &visit) const;
    void make_room(ProxyId proxy);
    Index allocate_pair();
    void free_pair(Index first);
    Index find_sibling(const FloatBox &box, Index start) const;
    Index open_pair(Index node);
    void insert_below(ProxyId proxy, const FloatBox &box, Index start);
    Index take_out(ProxyId proxy);
    void adopt(Index node);
    void move_node(Index from, Index to);
    void swap_nodes(Index left, Index right);
    void refit_upwards(Index node);
    void shrink_upwards(Index node);
    void rotate(Index node);
    class Builder;
    bool consistent(Index node) const;
    int depth(Index node) const;

    std::vector<Node, CacheLineAllocator<Node>> nodes_;
    std::vector<Index> free_pairs_;
    std::vector<Index> leaf_node_; // by proxy
};

// Depth first. Whether the box of a branch overlaps is as good as random: store always, advance on a hit.
template <typename Probe, typename Visit>
void EnvelopeTree::walk_below(Index pair, const Probe &probe, const Visit &visit) const
{
    Index waiting[walk_room]; // pairs of siblings whose parent overlaps
    waiting[0] = pair;
    for (std::size_t count = 1; count > 0;)
    {
        const Index next = waiting[--count];
        if (count + 2 > walk_room)
        {
            walk_below(next, probe, visit);
            continue;
        }
        const Node *const two = &nodes_[static_cast<std::size_t>(next)];
        for (const Node *node = two; node < two + 2; ++node)
        {
            const bool overlaps = probe.overlaps(node->box);
            waiting[count] = node->content;
            count += overlaps & !node->leaf();
            if (overlaps & node->leaf())
                visit(node->proxy());
        }
    }
}

// Level by level, so that the processor can look at several pairs of siblings at once: their addresses are known long before
// their boxes. Whether a box overlaps is as good as random: store always, advance on a hit.
template <typename Probe, typename Visit>
void EnvelopeTree::walk_together(const Probe *probes, std::size_t count, Visit visit) const
{
    if (nodes_.empty())
        return;
    Step waiting[walk_room]; // a ring
    std::size_t begin = 0, end = 0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        waiting[end] = {nodes_[0].content, i};
        end += probes[i].overlaps(nodes_[0].box);
    }
    while (begin < end)
    {
        const Step step = waiting[begin++ % walk_room];
        const Probe &probe = probes[step.probe];
        const auto visit_one = [&](ProxyId proxy) { visit(step.probe, proxy); };
        if (step.content < 0)
            visit_one(static_cast<ProxyId>(~step.content));
        else if (end - begin + 2 > walk_room)
            walk_below(step.content, probe, visit_one);
        else
        {
            const Node *const two = &nodes_[static_cast<std::size_t>(step.content)];
            for (const Node *node = two; node < two + 2; ++node)
            {
                waiting[end % walk_room] = {node->content, step.probe};
                prefetch(&nodes_[static_cast<std::size_t>(std::max(node->content, 0))]);
                end += probe.overlaps(node->box);
            }
        }
    }
}
} // namespace ode_predictive_space

#endif
