#include "ode_predictive_space/broadphase/index/envelope_tree.h"

#include <algorithm>
#include <limits>

namespace ode_predictive_space
{
namespace
{
Float4 half_areas(const Float4 *sides)
{
    return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
}

// The place whose box grows least when another is merged into it; of those that grow alike, the smallest (Guttman 1984).
std::size_t place_of_least_growth(const FourBoxes &boxes, std::size_t count, const FloatBox &box)
{
    Float4 sides[3], grown_sides[3];
    for (int axis = 0; axis < 3; ++axis)
    {
        sides[axis] = boxes.highs(axis) - boxes.lows(axis);
        grown_sides[axis] =
            max(boxes.highs(axis), Float4::all(box.high[axis])) - min(boxes.lows(axis), Float4::all(box.low[axis]));
    }
    float area[FourBoxes::most], growth[FourBoxes::most];
    half_areas(sides).store(area);
    (half_areas(grown_sides) - half_areas(sides)).store(growth);
    std::size_t best = 0;
    for (std::size_t place = 1; place < count; ++place)
        if (growth[place] < growth[best] || (growth[place] == growth[best] && area[place] < area[best]))
            best = place;
    return best;
}
} // namespace

void EnvelopeTree::make_room(ProxyId proxy)
{
    if (proxy >= leaf_place_.size())
        leaf_place_.resize(std::max<std::size_t>(proxy + 1, 2 * leaf_place_.size()), none);
}

EnvelopeTree::Index EnvelopeTree::allocate()
{
    Index node = free_;
    if (node != none)
        free_ = nodes_[node].parent;
    else
    {
        node = static_cast<Index>(nodes_.size());
        resize_array(nodes_, nodes_.size() + 1);
    }
    nodes_[node] = Node();
    return node;
}

void EnvelopeTree::release(Index node)
{
    nodes_[node].parent = free_;
    free_ = node;
}

void EnvelopeTree::put(Index place, const Entry &entry)
{
    Node &node = node_of(place);
    node.boxes.set(place % width, entry.box);
    node.content[place % width] = entry.content;
    if (entry.content < 0)
        leaf_place_[static_cast<ProxyId>(~entry.content)] = place;
    else
        nodes_[entry.content].parent = place;
}

void EnvelopeTree::clear()
{
    nodes_.clear();
    std::fill(leaf_place_.begin(), leaf_place_.end(), none);
    root_ = free_ = none;
}

void EnvelopeTree::insert(ProxyId proxy, const FloatBox &box)
{
    make_room(proxy);
    if (empty())
        root_ = allocate();
    Index index = root_;
    for (Node *node = &nodes_[index]; node->count > 0 && !node->is_lowest(); node = &nodes_[index])
    {
        const std::size_t place = place_of_least_growth(node->boxes, node->count, box);
        node->boxes.enlarge(place, box);
        index = node->content[place];
    }
    add(index, {box, static_cast<Index>(~proxy)});
}

void EnvelopeTree::add(Index index, const Entry &entry)
{
    Node &node = nodes_[index];
    if (node.is_full())
        split(index, entry);
    else
        put(width * index + node.count++, entry);
}

namespace
{
// Contents differ, so the order is the same on every machine.
template <typename Overfull> void sort_along(Overfull &entries, int axis)
{
    std::sort(entries.begin(), entries.end(), [axis](const auto &one, const auto &other) {
        const float place = one.box.doubled_centre(axis), other_place = other.box.doubled_centre(axis);
        return place != other_place ? place < other_place : one.content < other.content;
    });
}

// Sorts the entries along the best axis for a cut into two and three, or three and two. The best cut has the least sum of half
// areas, each times the number of its entries.
// @return the number of entries in the first part.
template <typename Overfull> std::size_t cut(Overfull &entries)
{
    Overfull best = entries;
    std::size_t size = 2;
    float least = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis)
    {
        sort_along(entries, axis);
        const FloatBox first = entries[0].box.merged(entries[1].box), last = entries[3].box.merged(entries[4].box);
        const FloatBox &middle = entries[2].box;
        const float early = 2 * first.half_area() + 3 * last.merged(middle).half_area(),
                    late = 3 * first.merged(middle).half_area() + 2 * last.half_area();
        if (!(std::min(early, late) < least))
            continue;
        least = std::min(early, late);
        size = early <= late ? 2 : 3;
        best = entries;
    }
    entries = best;
    return size;
}
} // namespace

void EnvelopeTree::fill(Index node, const Entry *begin, const Entry *end)
{
    nodes_[node].boxes = FourBoxes();
    nodes_[node].count = static_cast<Index>(end - begin);
    for (Index place = width * node; begin < end; ++begin, ++place)
        put(place, *begin);
}

// Moves a part of the entries into a new sibling. If the node is the root, a new root holds both.
void EnvelopeTree::split(Index index, const Entry &extra)
{
    Overfull entries;
    for (std::size_t place = 0; place < FourBoxes::most; ++place)
        entries[place] = {nodes_[index].boxes[place], nodes_[index].content[place]};
    entries.back() = extra;
    const std::size_t size = cut(entries);
    const Index sibling = allocate();
    fill(index, entries.data(), entries.data() + size);
    fill(sibling, entries.data() + size, entries.data() + entries.size());
    const Entry left = {nodes_[index].boxes.merged(), index};
    const Entry right = {nodes_[sibling].boxes.merged(), sibling};
    const Index parent = nodes_[index].parent;
    if (parent == none)
    {
        root_ = allocate();
        add(root_, left);
        return add(root_, right);
    }
    put(parent, left);
    add(parent / width, right);
}

namespace
{
// Splits the leaves into halves along the axis of the largest spread, unless there is room for all.
// @return the beginning of the second half, or `end`.
SweptProxy *halve(SweptProxy *begin, SweptProxy *end, std::ptrdiff_t room)
{
    if (end - begin <= room)
        return end;
    Float4 least = begin->box.doubled_centres(), most = least;
    for (const SweptProxy *leaf = begin + 1; leaf < end; ++leaf)
    {
        least = min(least, leaf->box.doubled_centres());
        most = max(most, leaf->box.doubled_centres());
    }
    float spread[4];
    (most - least).store(spread);
    const auto axis = static_cast<int>(std::max_element(spread, spread + 3) - spread);
    SweptProxy *const middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [axis](const SweptProxy &one, const SweptProxy &other) {
        const float place = one.box.doubled_centre(axis), other_place = other.box.doubled_centre(axis);
        return place != other_place ? place < other_place : one.proxy < other.proxy;
    });
    return middle;
}
} // namespace

void EnvelopeTree::build(std::vector<SweptProxy> leaves)
{
    clear();
    if (leaves.empty())
        return;
    for (const SweptProxy &leaf : leaves)
        make_room(leaf.proxy);
    std::ptrdiff_t room_below = 1;
    while (width * room_below < static_cast<std::ptrdiff_t>(leaves.size()))
        room_below *= width;
    root_ = built(leaves.data(), leaves.data() + leaves.size(), room_below);
}

// @param room_below maximum number of leaves below one of its places.
EnvelopeTree::Index EnvelopeTree::built(SweptProxy *begin, SweptProxy *end, std::ptrdiff_t room_below)
{
    const Index index = allocate();
    SweptProxy *const middle = halve(begin, end, room_below);
    SweptProxy *const parts[] = {begin, halve(begin, middle, room_below), middle, halve(middle, end, room_below), end};
    for (int i = 0; i < width; ++i)
    {
        if (parts[i] == parts[i + 1])
            continue;
        if (room_below == 1)
            add(index, {parts[i]->box, static_cast<Index>(~parts[i]->proxy)});
        else
        {
            const Index below = built(parts[i], parts[i + 1], room_below / width);
            add(index, {nodes_[below].boxes.merged(), below});
        }
    }
    return index;
}

// A leaf that stays within a nearby ancestor's box keeps its place; remove() and insert() would take several times as long.
void EnvelopeTree::move(ProxyId proxy, const FloatBox &box)
{
    const Index place = leaf_place_[proxy];
    Index holder = node_of(place).parent;
    for (int level = 0; level < tuning::levels_nearby && holder != none; ++level, holder = node_of(holder).parent)
        if (box_at(holder).contains(box))
        {
            node_of(place).boxes.set(place % width, box);
            return refit_upwards(place / width);
        }
    remove(proxy);
    insert(proxy, box);
}

void EnvelopeTree::remove(ProxyId proxy)
{
    const Index place = leaf_place_[proxy];
    leaf_place_[proxy] = none;
    take_out(place);
}

// Fills the gap with the node's last place. Releases empty nodes, and roots with a single child.
void EnvelopeTree::take_out(Index place)
{
    Node &node = node_of(place);
    const auto last = static_cast<std::size_t>(--node.count);
    if (place % width != node.count)
        put(place, {node.boxes[last], node.content[last]});
    node.boxes.clear(last);
    if (node.count > 0)
        refit_upwards(place / width);
    else if (node.parent == none)
        return clear();
    else
    {
        const Index parent = node.parent;
        release(place / width);
        return take_out(parent);
    }
    for (const Node *root = &nodes_[root_]; root->count == 1 && !root->is_lowest(); root = &nodes_[root_])
    {
        release(root_);
        root_ = root->content[0];
        nodes_[root_].parent = none;
    }
}

void EnvelopeTree::refit_upwards(Index index)
{
    for (Index place = nodes_[index].parent; place != none; place = node_of(place).parent)
    {
        const FloatBox box = nodes_[index].boxes.merged();
        if (box == box_at(place))
            return;
        index = place / width;
        node_of(place).boxes.set(place % width, box);
    }
}

bool EnvelopeTree::refit(const std::vector<SweptProxy> &leaves)
{
    for (const SweptProxy &leaf : leaves)
    {
        const Index place = leaf_place_[leaf.proxy];
        node_of(place).boxes.set(place % width, leaf.box);
    }
    float before = 0;
    return empty() || refit_below(root_, before) <= tuning::worse_by_refitting * before;
}

// @param before increased by the former half areas of all boxes of nodes below.
// @return the sum of their new half areas.
float EnvelopeTree::refit_below(Index index, float &before)
{
    Node &node = nodes_[index];
    float sum = 0;
    if (!node.is_lowest())
        for (Index place = width * index; place < width * index + node.count; ++place)
        {
            const Index below = node.content[place % width];
            before += box_at(place).half_area();
            sum += refit_below(below, before);
            node.boxes.set(place % width, nodes_[below].boxes.merged());
            sum += box_at(place).half_area();
        }
    return sum;
}

bool EnvelopeTree::consistent() const
{
    return empty() || (nodes_[root_].parent == none && consistent(root_, depth()));
}

bool EnvelopeTree::consistent(Index index, int depth) const
{
    const Node &node = nodes_[index];
    if (node.count < 1 || node.count > width || node.is_lowest() != (depth == 1))
        return false;
    for (Index i = 0; i < node.count; ++i)
    {
        const Index content = node.content[i], place = width * index + i;
        if (node.is_lowest() ? leaf_place_[static_cast<ProxyId>(~content)] != place
                             : nodes_[content].parent != place || !(box_at(place) == nodes_[content].boxes.merged()) ||
                                   !consistent(content, depth - 1))
            return false;
    }
    return true;
}

int EnvelopeTree::depth() const
{
    if (empty())
        return 0;
    int depth = 1;
    for (const Node *node = &nodes_[root_]; !node->is_lowest(); node = &nodes_[node->content[0]])
        ++depth;
    return depth;
}

std::size_t EnvelopeTree::bytes() const
{
    return nodes_.capacity() * sizeof(Node) + leaf_place_.capacity() * sizeof(Index);
}
} // namespace ode_predictive_space
