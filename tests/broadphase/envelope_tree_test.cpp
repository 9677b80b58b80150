#include "ode_predictive_space/broadphase/index/envelope_tree.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
class CheckedTree
{
public:
    void insert(ProxyId proxy, const FloatBox &box)
    {
        tree_.insert(proxy, box);
        boxes_[proxy] = box;
    }

    void remove(ProxyId proxy)
    {
        tree_.remove(proxy);
        boxes_.erase(proxy);
    }

    void move(ProxyId proxy, const FloatBox &box)
    {
        tree_.move(proxy, box);
        boxes_[proxy] = box;
    }

    void rebuild()
    {
        std::vector<SweptProxy> leaves;
        for (const auto &[proxy, box] : boxes_)
            leaves.push_back({proxy, box});
        tree_.build(leaves);
    }

    template <typename NewBox> bool refit(NewBox new_box)
    {
        std::vector<SweptProxy> leaves;
        for (auto &[proxy, box] : boxes_)
            leaves.push_back({proxy, box = new_box(box)});
        return tree_.refit(leaves);
    }

    bool contains(ProxyId proxy) const { return boxes_.count(proxy) == 1; }
    std::size_t size() const { return boxes_.size(); }
    const EnvelopeTree &tree() const { return tree_; }

    void expect_found(const FloatBox &box) const
    {
        std::vector<ProxyId> found, expected;
        tree_.walk(BoxProbe(box), [&](ProxyId proxy) { found.push_back(proxy); });
        std::sort(found.begin(), found.end());
        for (const auto &[proxy, stored] : boxes_)
            if (stored.overlaps(box))
                expected.push_back(proxy);
        ASSERT_EQ(found, expected);
    }

    void expect_consistent() const
    {
        ASSERT_TRUE(tree_.consistent());
        ASSERT_EQ(tree_.empty(), boxes_.empty());
    }

    void expect_all_found() const
    {
        expect_consistent();
        expect_found({{-1e15f, -1e15f, -1e15f}, {1e15f, 1e15f, 1e15f}});
        for (const auto &[proxy, box] : boxes_)
        {
            expect_found(box);
            ASSERT_EQ(tree_.box(proxy).low[0], box.low[0]);
        }
    }

private:
    EnvelopeTree tree_;
    std::map<ProxyId, FloatBox> boxes_;
};

struct Shape
{
    const char *name;
    double spread;
    double size;
    std::size_t proxies;
};

void PrintTo(const Shape &shape, std::ostream *out)
{
    *out << shape.name;
}

class AnyTree : public testing::TestWithParam<Shape>
{};

TEST_P(AnyTree, AnswersAsBruteForceDoesAfterEveryChange)
{
    const Shape shape = GetParam();
    Random random(1);
    CheckedTree checked;
    for (int step = 0; step < 6000; ++step)
    {
        const ProxyId proxy = static_cast<ProxyId>(random.index(shape.proxies));
        const FloatBox box = random.box(shape.spread, shape.size);
        if (random.chance(0.003))
            checked.rebuild();
        else if (random.chance(0.003))
            checked.refit([&](const FloatBox &) { return random.box(shape.spread, shape.size); });
        else if (!checked.contains(proxy))
            checked.insert(proxy, box);
        else if (random.chance(0.5))
            checked.move(proxy, box);
        else
            checked.remove(proxy);
        ASSERT_NO_FATAL_FAILURE(checked.expect_consistent()) << "step " << step;
        ASSERT_NO_FATAL_FAILURE(checked.expect_found(box)) << "step " << step;
        if (step % 500 == 0)
        {
            ASSERT_NO_FATAL_FAILURE(checked.expect_all_found()) << "step " << step;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EnvelopeTree, AnyTree,
                         testing::Values(Shape{"few", 1, 1, 4}, Shape{"some", 1, 0.5, 60}, Shape{"many", 10, 1, 1000},
                                         Shape{"crowded", 0.1, 1, 200}, Shape{"huge", 1e14, 1e12, 200},
                                         Shape{"points", 1, 0, 200}, Shape{"all_in_one_point", 0, 0, 200}),
                         [](const auto &info) { return info.param.name; });

TEST(EnvelopeTree, TellsWhenItHasBecomeMuchWorseByRefitting)
{
    Random random(2);
    CheckedTree checked;
    for (ProxyId proxy = 0; proxy < 500; ++proxy)
        checked.insert(proxy, random.box(10, 0.1));
    checked.rebuild();
    EXPECT_TRUE(checked.refit([](const FloatBox &box) {
        return FloatBox{{box.low[0] + 100, box.low[1], box.low[2]}, {box.high[0] + 100, box.high[1], box.high[2]}};
    })) << "all have moved alike";
    EXPECT_TRUE(checked.refit([&](const FloatBox &box) {
        const float step = static_cast<float>(random.uniform(-0.01, 0.01));
        return FloatBox{{box.low[0], box.low[1] + step, box.low[2]}, {box.high[0], box.high[1] + step, box.high[2]}};
    })) << "hardly any has other neighbours";
    EXPECT_FALSE(checked.refit([&](const FloatBox &) { return random.box(10, 0.1); }))
        << "none has the same neighbours";
    checked.expect_all_found();
    EXPECT_TRUE(CheckedTree().refit([](const FloatBox &box) { return box; })) << "empty as before";
}

int ideal_depth(std::size_t leaves)
{
    int depth = 1;
    for (std::size_t room = FourBoxes::most; room < leaves; room *= FourBoxes::most)
        ++depth;
    return depth;
}

class CountingProbe
{
public:
    CountingProbe(const FloatBox &box, std::size_t &asked) : probe_(box), asked_(asked) {}

    unsigned overlaps(const FourBoxes &boxes) const
    {
        ++asked_;
        return probe_.overlaps(boxes);
    }

private:
    BoxProbe probe_;
    std::size_t &asked_;
};

struct Effort
{
    std::size_t asked = 0;
    std::size_t found = 0;
};

Effort effort_of(const EnvelopeTree &tree, const FloatBox &box)
{
    Effort effort;
    tree.walk(CountingProbe(box, effort.asked), [&](ProxyId) { ++effort.found; });
    return effort;
}

// Unit cubes, on average 100 in a cube of side 10, whatever their number.
std::vector<SweptProxy> spread_cubes(Random &random, std::size_t count)
{
    const double spread = 0.5 * std::cbrt(10.0 * static_cast<double>(count));
    std::vector<SweptProxy> cubes;
    for (std::size_t i = 0; i < count; ++i)
    {
        const Vector3 centre = random.vector(spread), half = Vector3::Constant(0.5);
        cubes.push_back({static_cast<ProxyId>(i), FloatBox::around(Box(centre - half, centre + half))});
    }
    return cubes;
}

// Nodes visited, per level of an ideal tree and per leaf found, in 100 queries: bounded if a query is O(log n + k).
double nodes_per_level_and_leaf(const EnvelopeTree &tree, const std::vector<SweptProxy> &cubes)
{
    Effort effort;
    constexpr std::size_t queries = 100;
    for (std::size_t i = 0; i < queries; ++i)
    {
        const Effort one = effort_of(tree, cubes[i * (cubes.size() / queries)].box);
        effort.asked += one.asked;
        effort.found += one.found;
    }
    EXPECT_GE(effort.found, queries);
    const std::size_t levels = queries * static_cast<std::size_t>(ideal_depth(cubes.size()));
    return static_cast<double>(effort.asked) / static_cast<double>(levels + effort.found);
}

TEST(EnvelopeTree, AQueryLooksAtFewNodesOfMany)
{
    for (std::size_t count : {1000, 10000, 100000})
    {
        Random random(count);
        std::vector<SweptProxy> cubes = spread_cubes(random, count);
        EnvelopeTree filled, built;
        for (const SweptProxy &cube : cubes)
            filled.insert(cube.proxy, cube.box);
        EXPECT_LE(nodes_per_level_and_leaf(filled, cubes), 3.5) << count << " one by one"; // measured: 1.5 to 2.8
        built.build(cubes);
        EXPECT_LE(nodes_per_level_and_leaf(built, cubes), 1.4) << count << " at once"; // measured: 1.1 to 1.2
    }
}

TEST(EnvelopeTree, AQueryThatMeetsNothingEndsAtTheRoot)
{
    Random random(1);
    std::vector<SweptProxy> cubes = spread_cubes(random, 10000);
    EnvelopeTree tree;
    EXPECT_EQ(effort_of(tree, {{0, 0, 0}, {1, 1, 1}}).asked, 0u);
    tree.build(cubes);
    const Effort effort = effort_of(tree, {{1000, 0, 0}, {1001, 1, 1}});
    EXPECT_EQ(effort.asked, 1u);
    EXPECT_EQ(effort.found, 0u);
}

TEST(EnvelopeTree, QueriesThatGoDownTogetherFindWhatEachFindsAlone)
{
    Random random(3);
    for (std::size_t count : {1, 5, 300, 20000})
    {
        EnvelopeTree tree;
        tree.build(spread_cubes(random, count));
        // Among the small probes are large ones that fill the buffer of a walk even alone.
        std::vector<BoxProbe> probes;
        for (std::size_t i = 0; i < EnvelopeTree::most_together; ++i)
            probes.emplace_back(random.box(20, i % 4 == 0 ? 1000 : 5));
        using Found = std::vector<std::pair<std::size_t, ProxyId>>;
        Found together, alone;
        tree.walk_together(probes.data(), probes.size(),
                           [&](std::size_t i, ProxyId proxy) { together.emplace_back(i, proxy); });
        for (std::size_t i = 0; i < probes.size(); ++i)
            tree.walk(probes[i], [&](ProxyId proxy) { alone.emplace_back(i, proxy); });
        std::sort(together.begin(), together.end());
        std::sort(alone.begin(), alone.end());
        ASSERT_EQ(together, alone) << count;
        EXPECT_GE(together.size(), count) << "some find all";
    }
}

TEST(EnvelopeTree, LargeQueriesFindEachLeafOnce)
{
    Random random(2);
    CheckedTree checked;
    for (const SweptProxy &cube : spread_cubes(random, 20000))
        checked.insert(cube.proxy, cube.box);
    checked.expect_found({{-1e6f, -1e6f, -1e6f}, {1e6f, 1e6f, 1e6f}});
    checked.expect_found({{-1e6f, -1e6f, -1e6f}, {0, 1e6f, 1e6f}});
    const Effort effort = effort_of(checked.tree(), {{-1e6f, -1e6f, -1e6f}, {1e6f, 1e6f, 1e6f}});
    EXPECT_GT(effort.asked, checked.size() / 4);
    EXPECT_LT(effort.asked, checked.size()) << "each node of the tree is looked at once, and holds two at least";
}
} // namespace
} // namespace ode_predictive_space
