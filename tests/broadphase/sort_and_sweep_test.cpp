#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/pairs.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
using Items = std::vector<SweptProxy>;

void expect_all_pairs(SortAndSweep &sweep, const Items &items)
{
    std::vector<CandidatePair> found;
    sweep.find_pairs(items, found);
    for (const CandidatePair &pair : found)
        ASSERT_LT(pair.first, pair.second);
    Pairs expected;
    for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t j = i + 1; j < items.size(); ++j)
            if (items[i].box.overlaps(items[j].box))
                expected.push_back(std::minmax(items[i].proxy, items[j].proxy));
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(sorted_pairs(found), expected) << items.size() << " boxes";
}

Items random_items(Random &random, std::size_t count, double spread, double size)
{
    Items items;
    for (std::size_t i = 0; i < count; ++i)
        items.push_back({static_cast<ProxyId>(3 * (count - i)), random.box(spread, size)});
    return items;
}

TEST(SortAndSweep, FindsTheOverlappingPairsOfAnyNumberOfBoxes)
{
    Random random(1);
    SortAndSweep sweep;
    for (std::size_t count : {0, 1, 2, 3, 10, 100, 255, 256, 257, 1000, 3000})
        expect_all_pairs(sweep, random_items(random, count, 1, 0.3));
    for (std::size_t count = 0; count < 60; ++count)
        for (int repetition = 0; repetition < 20; ++repetition)
            expect_all_pairs(sweep, random_items(random, count, 1, 1));
}

// Boxes of all widths, enough for several slabs. If all meet along the axis, the last of a slab meets the first of the next.
TEST(SortAndSweep, BoxesInSeveralSlabsAreFoundOnce)
{
    Random random(8);
    SortAndSweep sweep;
    for (double part_of_wide : {0.0, 0.02, 0.3})
        for (double width : {0.02, 1.0, 4.0})
            for (float length : {0.3f, 200.0f})
            {
                Items items;
                for (ProxyId id = 0; id < 4000; ++id)
                {
                    FloatBox box = random.box(20, 0.5);
                    // Along this axis they have the widest spread.
                    box.low[0] *= 2;
                    box.high[0] = box.low[0] + length;
                    const double wide = random.chance(part_of_wide) ? random.uniform(0, 60) : width;
                    box.high[1] = box.low[1] + static_cast<float>(wide);
                    items.push_back({id, box});
                }
                expect_all_pairs(sweep, items);
            }
}

// Boxes that are so long that they meet boxes that begin anywhere along them; in rows of eight, some are of another slab.
TEST(SortAndSweep, LongBoxesInSlabsOfAFewAreFoundOnce)
{
    Random random(3);
    SortAndSweep sweep;
    for (double slabs : {30, 300, 1000, 3000})
    {
        Items items;
        for (ProxyId id = 0; id < 5000; ++id)
        {
            const auto x = static_cast<float>(slabs * random.uniform(-1, 1));
            const auto y = static_cast<float>(slabs * random.uniform(-0.5, 0.5)),
                       z = static_cast<float>(random.index(4));
            const auto length = static_cast<float>(slabs * random.uniform(0, 2));
            items.push_back({id, {{x, y, z}, {x + length, y + 1, z + 0.5f}}});
        }
        expect_all_pairs(sweep, items);
    }
}

// A few distant boxes must not spoil the resolution for the others, and all may be in a plane or on a line.
TEST(SortAndSweep, FindsThemWhereverTheOthersLie)
{
    Random random(9);
    SortAndSweep sweep;
    for (int flat_axes : {0, 1, 2})
        for (float far : {0.0f, 1e4f, 1e14f})
        {
            Items items = random_items(random, 3000, 1, 0.1);
            for (SweptProxy &item : items)
                for (int axis = 0; axis < flat_axes; ++axis)
                    item.box.low[axis] = item.box.high[axis] = 0.25f;
            for (ProxyId i = 0; i < 20; ++i)
                for (int axis = 0; axis < 3; ++axis)
                {
                    FloatBox &box = items[149 * i].box;
                    box.low[axis] += far;
                    box.high[axis] += far;
                }
            expect_all_pairs(sweep, items);
        }
}

// Boxes are sorted by 65,536 places, so two that begin at the same place need not overlap.
TEST(SortAndSweep, TinyBoxesAtTheSamePlaceAreToldApart)
{
    Random random(4);
    SortAndSweep sweep;
    for (ProxyId count : {500, 3000})
    {
        Items items;
        for (ProxyId id = 0; id < count; ++id)
        {
            // Each cluster is much smaller than a place.
            const ProxyId cluster = id / 8;
            const float x = static_cast<float>(cluster) + static_cast<float>(random.index(8)) * 0x1p-14f;
            items.push_back({id, {{x, 0, 0}, {x + 0x1p-14f * static_cast<float>(random.index(3)) / 2, 0.1f, 0.1f}}});
        }
        expect_all_pairs(sweep, items);
    }
}

// Boxes in a grid that do not touch, row by row; x varies slowest, second or fastest.
Items grid_row_by_row(int side, int turn)
{
    Items items;
    for (int i = 0; i < side * side * side; ++i)
    {
        const int place[] = {i % side, i / side % side, i / side / side};
        FloatBox box;
        for (int axis = 0; axis < 3; ++axis)
        {
            box.low[axis] = static_cast<float>(place[(axis + turn) % 3]);
            box.high[axis] = box.low[axis] + 0.9f;
        }
        items.push_back({static_cast<ProxyId>(i), box});
    }
    return items;
}

// A sample with an even stride may hit a single plane of a grid, and see no spread across it. Once, the row-by-row order took
// 4,029,696 exact comparisons, and the shuffled one 355.
TEST(SortAndSweep, TheOrderOfAGridCostsFewComparisons)
{
    Random random(10);
    SortAndSweep sweep;
    std::vector<CandidatePair> none;
    for (int turn = 0; turn < 3; ++turn)
    {
        const Items rows = grid_row_by_row(24, turn);
        Items shuffled = rows;
        for (std::size_t i = shuffled.size() - 1; i > 0; --i)
            std::swap(shuffled[i], shuffled[random.index(i + 1)]);
        const std::size_t of_shuffled = sweep.find_pairs(shuffled, none), of_rows = sweep.find_pairs(rows, none);
        EXPECT_LE(of_rows, 2 * of_shuffled + rows.size() / 10);
        EXPECT_LE(of_shuffled, rows.size() / 10);
    }
    EXPECT_TRUE(none.empty());
}

TEST(SortAndSweep, InfiniteBoxesMeetAllThatIsInTheirReach)
{
    Random random(3);
    SortAndSweep sweep;
    for (std::size_t count : {20, 500})
    {
        Items items = random_items(random, count, 2, 0.5);
        for (int i = 0; i < 8; ++i)
        {
            FloatBox half_space = random.box(2, 0.5);
            for (int axis = 0; axis < 3; ++axis)
            {
                if (random.chance(0.5))
                    half_space.low[axis] = -float_infinity;
                if (random.chance(0.5))
                    half_space.high[axis] = float_infinity;
            }
            items.push_back({static_cast<ProxyId>(10000 + i), half_space});
        }
        items.push_back(
            {20000,
             {{-float_infinity, -float_infinity, -float_infinity}, {float_infinity, float_infinity, float_infinity}}});
        items.push_back(
            {20001,
             {{float_infinity, float_infinity, float_infinity}, {float_infinity, float_infinity, float_infinity}}});
        items.push_back({20002,
                         {{-float_infinity, -float_infinity, -float_infinity},
                          {-float_infinity, -float_infinity, -float_infinity}}});
        expect_all_pairs(sweep, items);
    }
}
} // namespace
} // namespace ode_predictive_space
