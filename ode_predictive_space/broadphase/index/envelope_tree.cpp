#include "ode_predictive_space/broadphase/index/envelope_tree.h"

#include <algorithm>

namespace ode_predictive_space
{
void EnvelopeTree::make_room(ProxyId proxy)
{
    if (proxy >= leaf_node_.size())
        leaf_node_.resize(std::max<std::size_t>(proxy + 1, 2 * leaf_node_.size()), none);
}

EnvelopeTree::Index EnvelopeTree::allocate_pair()
{
    if (!free_pairs_.empty())
    {
        const Index first = free_pairs_.back();
        free_pairs_.pop_back();
        return first;
    }
    const Index first = static_cast<Index>(nodes_.size());
    resize_array(nodes_, nodes_.size() + 2);
    return first;
}

void EnvelopeTree::free_pair(Index first)
{
    free_pairs_.push_back(first);
}

// Makes the nodes below, or the proxy in it, point to this node.
void EnvelopeTree::adopt(Index node)
{
    const Node &self = nodes_[node];
    if (self.leaf())
        leaf_node_[self.proxy()] = node;
    else
        nodes_[self.content].parent = nodes_[self.content + 1].parent = node;
}

void EnvelopeTree::move_node(Index from, Index to)
{
    nodes_[to].box = nodes_[from].box;
    nodes_[to].content = nodes_[from].content;
    adopt(to);
}

void EnvelopeTree::swap_nodes(Index left, Index right)
{
    std::swap(nodes_[left].box, nodes_[right].box);
    std::swap(nodes_[left].content, nodes_[right].content);
    adopt(left);
    adopt(right);
}

// Greedy descent: at each node, stop here (the new leaf becomes its sibling) or go into the child that grows least.
EnvelopeTree::Index EnvelopeTree::find_sibling(const FloatBox &box, Index start) const
{
    Index index = start;
    float merged = nodes_[start].box.merged_half_area(box);
    while (!nodes_[index].leaf())
    {
        const Node &node = nodes_[index];
        const float inherited = merged - node.box.half_area();
        float best = merged, best_grown = 0;
        Index next = none;
        for (Index child = node.content; child < node.content + 2; ++child)
        {
            const FloatBox &own = nodes_[child].box;
            const float grown = own.merged_half_area(box);
            const float cost = inherited + (nodes_[child].leaf() ? grown : grown - own.half_area());
            if (cost < best)
            {
                best = cost;
                best_grown = grown;
                next = child;
            }
        }
        if (next == none)
            return index;
        index = next;
        merged = best_grown;
    }
    return index;
}

void EnvelopeTree::clear()
{
    nodes_.clear();
    free_pairs_.clear();
    std::fill(leaf_node_.begin(), leaf_node_.end(), none);
}

void EnvelopeTree::insert(ProxyId proxy, const FloatBox &box)
{
    make_room(proxy);
    if (nodes_.empty())
    {
        nodes_.resize(2);
        nodes_[0] = {box, none, static_cast<Index>(~proxy)};
        leaf_node_[proxy] = 0;
        return;
    }
    insert_below(proxy, box, 0);
}

// The content of the node becomes the first of two children; the caller fills the second.
EnvelopeTree::Index EnvelopeTree::open_pair(Index node)
{
    const Index pair = allocate_pair();
    move_node(node, pair);
    nodes_[node].content = pair;
    return pair;
}

void EnvelopeTree::insert_below(ProxyId proxy, const FloatBox &box, Index start)
{
    const Index place = find_sibling(box, start);
    const Index pair = open_pair(place);
    nodes_[pair + 1].box = box;
    nodes_[pair + 1].content = static_cast<Index>(~proxy);
    adopt(pair + 1);
    adopt(place);
    refit_upwards(place);
}

// An envelope that stays among the same neighbours stays where it is: to take it out and to look for the best place takes several
// times as long. The tree does not get worse beyond the branch that held it and holds it now.
void EnvelopeTree::move(ProxyId proxy, const FloatBox &box)
{
    const Index leaf = leaf_node_[proxy];
    Index holder = leaf;
    for (int level = 0; level < tuning::levels_nearby && nodes_[holder].parent != none; ++level)
    {
        holder = nodes_[holder].parent;
        if (nodes_[holder].box.contains(box))
        {
            nodes_[leaf].box = box;
            shrink_upwards(nodes_[leaf].parent);
            return;
        }
    }
    Index start = take_out(proxy);
    if (start == none)
    {
        insert(proxy, box);
        return;
    }
    while (start != 0 && !nodes_[start].box.contains(box))
        start = nodes_[start].parent;
    insert_below(proxy, box, start);
}

// Returns the node that took the place of the proxy's parent; none when the tree is empty now.
EnvelopeTree::Index EnvelopeTree::take_out(ProxyId proxy)
{
    const Index leaf = leaf_node_[proxy];
    leaf_node_[proxy] = none;
    if (leaf == 0)
    {
        nodes_.clear();
        free_pairs_.clear();
        return none;
    }
    const Index parent = nodes_[leaf].parent;
    const Index pair = nodes_[parent].content;
    move_node(leaf ^ 1, parent);
    free_pair(pair);
    if (parent != 0)
        shrink_upwards(nodes_[parent].parent);
    return parent;
}

// After a removal. The next insertion improves the shape.
void EnvelopeTree::shrink_upwards(Index index)
{
    for (; index != none; index = nodes_[index].parent)
    {
        Node &node = nodes_[index];
        const FloatBox merged = nodes_[node.content].box.merged(nodes_[node.content + 1].box);
        if (merged == node.box)
            return;
        node.box = merged;
    }
}

void EnvelopeTree::refit_upwards(Index index)
{
    for (; index != none; index = nodes_[index].parent)
    {
        Node &node = nodes_[index];
        const FloatBox merged = nodes_[node.content].box.merged(nodes_[node.content + 1].box);
        const bool unchanged = merged == node.box;
        node.box = merged;
        rotate(index);
        if (unchanged)
            return;
    }
}

// Exchanges a child with a grandchild from the other side when that makes the other child smaller.
void EnvelopeTree::rotate(Index index)
{
    const Index pair = nodes_[index].content;
    float best = 0;
    Index best_child = none, best_grandchild = none;
    for (Index child = pair; child < pair + 2; ++child)
    {
        const Index other = child ^ 1;
        if (nodes_[other].leaf())
            continue;
        const Index grandchildren = nodes_[other].content;
        const float area = nodes_[other].box.half_area();
        for (Index grandchild = grandchildren; grandchild < grandchildren + 2; ++grandchild)
        {
            const float gain = area - nodes_[child].box.merged_half_area(nodes_[grandchild ^ 1].box);
            if (gain > best)
            {
                best = gain;
                best_child = child;
                best_grandchild = grandchild;
            }
        }
    }
    if (best_child == none)
        return;
    swap_nodes(best_child, best_grandchild);
    Node &changed = nodes_[best_child ^ 1];
    changed.box = nodes_[changed.content].box.merged(nodes_[changed.content + 1].box);
}

bool EnvelopeTree::consistent() const
{
    return nodes_.empty() || (nodes_[0].parent == none && consistent(0));
}

bool EnvelopeTree::consistent(Index index) const
{
    const Node &node = nodes_[index];
    if (node.leaf())
        return leaf_node_[node.proxy()] == index;
    for (Index child = node.content; child < node.content + 2; ++child)
        if (nodes_[child].parent != index || !node.box.contains(nodes_[child].box) || !consistent(child))
            return false;
    return true;
}

int EnvelopeTree::depth(Index index) const
{
    const Node &node = nodes_[index];
    return node.leaf() ? 1 : 1 + std::max(depth(node.content), depth(node.content + 1));
}

std::size_t EnvelopeTree::bytes() const
{
    return nodes_.capacity() * sizeof(Node) + (free_pairs_.capacity() + leaf_node_.capacity()) * sizeof(Index);
}
} // namespace ode_predictive_space
