// A dynamic tree of boxes: which envelopes can meet a given one? Many queries go down together, and a large change rebuilds the
// whole tree.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_ENVELOPE_TREE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_ENVELOPE_TREE_H

#include <array>
#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/base/four_boxes.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/base/prefetch.h"

namespace ode_predictive_space
{
/// An R-tree (Guttman 1984) of bounded boxes: each node has up to four boxes, around the nodes below it or, in the lowest level, of
/// objects. A visit of a node compares all four at once. All ways from the root down are equally long.
class EnvelopeTree
{
public:
    /// Adds a proxy that is not in the tree. The box must be bounded().
    void insert(ProxyId proxy, const FloatBox &box);

    /// Removes a proxy that is in the tree.
    void remove(ProxyId proxy);

    /// Gives a proxy that is in the tree another box: the same as remove() and insert(), but quicker when the box is near
    /// the old one, because it stays where it is.
    void move(ProxyId proxy, const FloatBox &box);

    /// Removes all proxies.
    void clear();

    /// Replaces the whole tree by one over these leaves, built from the top: for when many boxes change at once.
    void build(std::vector<SweptProxy> leaves);

    /// Gives all proxies in the tree other boxes, and leaves each where it is: for when many have moved, and most with their neighbours.
    ///
    /// @param leaves one for each proxy in the tree.
    /// @return false when the tree has become much worse than it was: it is to be built.
    bool refit(const std::vector<SweptProxy> &leaves);

    bool empty() const { return root_ == none; }

    /// Calls visit(proxy) for every proxy whose box overlaps the probe, which has any shape and a function
    /// `unsigned overlaps(const FourBoxes &) const` that gives a bit for each. The function is called for the boxes of whole branches,
    /// too, and must be true for a box that holds a box which it overlaps; for places without a box it may say anything.
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        if (!empty())
            walk_below(root_, probe, visit);
    }

    /// The same for several probes at once, which is faster where nodes are not in the cache: no probe waits for another's.
    ///
    /// @param count at most most_together.
    /// @param visit called as visit(i, proxy) for what the i-th probe overlaps; not in the order of the probes.
    template <typename Probe, typename Visit>
    void walk_together(const Probe *probes, std::size_t count, Visit visit) const;
    static constexpr std::size_t most_together = tuning::queries_together;

    /// The box stored for a proxy that is in the tree.
    FloatBox box(ProxyId proxy) const { return box_at(leaf_place_[proxy]); }

    /// Checks links and boxes.
    bool consistent() const;

    /// Nodes on each way from the root to a proxy.
    int depth() const;

    std::size_t bytes() const;

private:
    using Index = std::int32_t; // of a node; or of a place in one, as four times its index and the number of the place
    static constexpr Index none = -1;
    static constexpr Index width = FourBoxes::most;
    static constexpr std::size_t walk_room = 256;
    static_assert(most_together + width <= walk_room, "all probes begin in there");

    /// A node that the probe of this number overlaps.
    struct Step
    {
        Index node;
        std::uint32_t probe;
    };

    struct alignas(64) Node
    {
        FourBoxes boxes;      // the first `count` of them
        Index content[width]; // >= 0: the node in the box; < 0: ~proxy
        Index parent = none;  // the place that it is in; of a free node, the next one
        Index count = 0;
        bool is_lowest() const { return content[0] < 0; }
        bool is_full() const { return count == width; }
    };
    static_assert(sizeof(Node) == 128, "two cache lines");

    /// What a place holds.
    struct Entry
    {
        FloatBox box;
        Index content;
    };
    using Overfull = std::array<Entry, width + 1>;

    template <typename Probe, typename Visit> void walk_below(Index node, const Probe &probe, const Visit &visit) const;
    /// Calls visit(content) for each place of the node that the probe overlaps.
    template <typename Probe, typename Visit> static void look_at(const Node &node, const Probe &probe, Visit visit)
    {
        for (unsigned hits = probe.overlaps(node.boxes) & ~(~0u << node.count); hits != 0; hits &= hits - 1)
            visit(node.content[__builtin_ctz(hits)]);
    }

    Node &node_of(Index place) { return nodes_[place / width]; }
    FloatBox box_at(Index place) const { return nodes_[place / width].boxes[place % width]; }
    void make_room(ProxyId proxy);
    Index allocate();
    void release(Index node);
    void put(Index place, const Entry &entry);
    void add(Index node, const Entry &entry);
    void split(Index node, const Entry &extra);
    void fill(Index node, const Entry *begin, const Entry *end);
    void take_out(Index place);
    void refit_upwards(Index node);
    float refit_below(Index node, float &before);
    Index built(SweptProxy *begin, SweptProxy *end, std::ptrdiff_t room_below);
    bool consistent(Index node, int depth) const;

    std::vector<Node, CacheLineAllocator<Node>> nodes_;
    std::vector<Index> leaf_place_; // by proxy
    Index root_ = none, free_ = none;
};

// Depth first.
template <typename Probe, typename Visit>
void EnvelopeTree::walk_below(Index node, const Probe &probe, const Visit &visit) const
{
    Index waiting[walk_room];
    waiting[0] = node;
    for (std::size_t count = 1; count > 0;)
    {
        const Index next = waiting[--count];
        if (count + width > walk_room)
            walk_below(next, probe, visit);
        else
            look_at(nodes_[next], probe, [&](Index content) {
                if (content < 0)
                    visit(static_cast<ProxyId>(~content));
                else
                    waiting[count++] = content;
            });
    }
}

// Level by level, so that the processor can look at several nodes at once: their addresses are known long before their boxes.
template <typename Probe, typename Visit>
void EnvelopeTree::walk_together(const Probe *probes, std::size_t count, Visit visit) const
{
    if (empty())
        return;
    Step waiting[walk_room]; // a ring
    std::size_t begin = 0, end = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        waiting[end++] = {root_, i};
    while (begin < end)
    {
        const Step step = waiting[begin++ % walk_room];
        const Probe &probe = probes[step.probe];
        if (end - begin + width > walk_room)
            walk_below(step.node, probe, [&](ProxyId proxy) { visit(step.probe, proxy); });
        else
            look_at(nodes_[step.node], probe, [&](Index content) {
                if (content < 0)
                    return visit(step.probe, static_cast<ProxyId>(~content));
                waiting[end++ % walk_room] = {content, step.probe};
                prefetch_lines<sizeof(Node)>(&nodes_[content]);
            });
    }
}
} // namespace ode_predictive_space

#endif
