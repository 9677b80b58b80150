// A dynamic tree of boxes. In: envelopes. Out: those that overlap a probe, for one probe or several at once.

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
/// An R-tree (Guttman 1984) of bounded boxes. A node has up to four boxes, of its children or, in the lowest level, of objects;
/// a visit compares all four at once. All leaves have the same depth.
class EnvelopeTree
{
public:
    /// @pre the proxy is not in the tree, and the box is bounded().
    void insert(ProxyId proxy, const FloatBox &box);

    /// @pre the proxy is in the tree.
    void remove(ProxyId proxy);

    void move(ProxyId proxy, const FloatBox &box);

    void clear();

    void build(std::vector<SweptProxy> leaves);

    /// Replaces the boxes of all proxies and keeps the structure, which suits proxies that have moved with their neighbours.
    /// @param leaves one for each proxy in the tree.
    /// @return false if the tree has become much worse and should be built.
    bool refit(const std::vector<SweptProxy> &leaves);

    bool empty() const { return root_ == none; }

    /// Calls visit(proxy) for each proxy whose box overlaps the probe.
    /// @tparam Probe has `unsigned overlaps(const FourBoxes &) const`, which returns one bit per place; bits of empty places
    ///     are ignored. A probe that overlaps a box must overlap each box around it, too.
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        if (!empty())
            walk_below(root_, probe, visit);
    }

    /// Walks several probes at once, which is faster if nodes are not in the cache. Calls visit(i, proxy) for each proxy that
    /// the i-th probe overlaps, not in the order of the probes.
    /// @param count at most most_together.
    template <typename Probe, typename Visit>
    void walk_together(const Probe *probes, std::size_t count, Visit visit) const;
    static constexpr std::size_t most_together = tuning::queries_together;

    /// @pre the proxy is in the tree.
    FloatBox box(ProxyId proxy) const { return box_at(leaf_place_[proxy]); }

    bool consistent() const;

    int depth() const;

    std::size_t bytes() const;

private:
    using Index = std::int32_t; // index of a node, or of a place: width * node + number of the place in it
    static constexpr Index none = -1;
    static constexpr Index width = FourBoxes::most;
    static constexpr std::size_t walk_room = 256;
    static_assert(most_together + width <= walk_room, "all probes begin in there");

    struct Step
    {
        Index node;
        std::uint32_t probe;
    };

    struct alignas(64) Node
    {
        FourBoxes boxes;      // the first `count` are in use
        Index content[width]; // >= 0: a node; < 0: ~proxy
        Index parent = none;  // the place of this node; in a free node, the next free one
        Index count = 0;
        bool is_lowest() const { return content[0] < 0; }
        bool is_full() const { return count == width; }
    };
    static_assert(sizeof(Node) == 128, "two cache lines");

    struct Entry
    {
        FloatBox box;
        Index content;
    };
    using Overfull = std::array<Entry, width + 1>;

    template <typename Probe, typename Visit> void walk_below(Index node, const Probe &probe, const Visit &visit) const;
    template <typename Probe, typename Visit> static void visit_hits(const Node &node, const Probe &probe, Visit visit)
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
            visit_hits(nodes_[next], probe, [&](Index content) {
                if (content < 0)
                    visit(static_cast<ProxyId>(~content));
                else
                    waiting[count++] = content;
            });
    }
}

// Breadth first, so that the cache misses of several nodes overlap: a node is prefetched long before it is read.
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
            visit_hits(nodes_[step.node], probe, [&](Index content) {
                if (content < 0)
                    return visit(step.probe, static_cast<ProxyId>(~content));
                waiting[end++ % walk_room] = {content, step.probe};
                prefetch_block<sizeof(Node)>(&nodes_[content]);
            });
    }
}
} // namespace ode_predictive_space

#endif
