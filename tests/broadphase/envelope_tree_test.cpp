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

    template <typename NewBox> void refit(NewBox new_box)
    {
        std::vector<SweptProxy> leaves;
        for (auto &[proxy, box] : boxes_)
            leaves.push_back({proxy, box = new_box(box)});
        tree_.refit(leaves);
    }

    bool contains(ProxyId proxy) const { return boxes_.count(proxy) == 1; }

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
    // The result is larger than the buffer of a walk.
    Random random(2);
    CheckedTree checked;
    for (const SweptProxy &cube : spread_cubes(random, 20000))
        checked.insert(cube.proxy, cube.box);
    checked.expect_found({{-1e6f, -1e6f, -1e6f}, {1e6f, 1e6f, 1e6f}});
    checked.expect_found({{-1e6f, -1e6f, -1e6f}, {0, 1e6f, 1e6f}});
}
} // namespace
} // namespace ode_predictive_space
