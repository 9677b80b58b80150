#include "ode_predictive_space/broadphase/index/box_list.h"

#include <iterator>
#include <limits>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
constexpr FloatBox everywhere = {{-float_infinity, -float_infinity, -float_infinity},
                                 {float_infinity, float_infinity, float_infinity}};

// A list beside what it should hold.
struct BoxListTest : testing::Test
{
    FloatBox random_box()
    {
        FloatBox box{};
        for (int axis = 0; axis < 3; ++axis)
        {
            box.low[axis] = static_cast<float>(random.uniform(0, 4));
            box.high[axis] = box.low[axis] + static_cast<float>(random.uniform(0, 2));
            // Touching counts; so do boxes without an end.
            if (random.chance(0.2))
                box.low[axis] = std::floor(box.low[axis]);
            if (random.chance(0.02))
                box.low[axis] = -float_infinity;
            if (random.chance(0.02))
                box.high[axis] = float_infinity;
        }
        return box;
    }

    void put(ProxyId id, const FloatBox &box)
    {
        list.put({id, box});
        expected[id] = box;
    }

    void remove(ProxyId id)
    {
        list.remove(id);
        expected.erase(id);
    }

    void expect_found(const FloatBox &box) const
    {
        std::set<ProxyId> overlapping, all;
        for (const auto &[id, other] : expected)
        {
            all.insert(id);
            if (box.overlaps(other))
                overlapping.insert(id);
        }
        expect_walked(BoxProbe(box), overlapping);
        expect_walked(ProbeOfAll(), all);
    }

    // It says that places without a box are met, too.
    struct ProbeOfAll
    {
        unsigned overlaps(const FourBoxes &) const { return four_lanes; }
    };

    template <typename Probe> void expect_walked(const Probe &probe, const std::set<ProxyId> &overlapping) const
    {
        std::set<ProxyId> walked;
        list.walk(probe, [&](ProxyId id) { EXPECT_TRUE(walked.insert(id).second) << id << " is found twice"; });
        EXPECT_EQ(walked, overlapping);
    }

    void expect_pairs_found() const
    {
        std::set<std::pair<ProxyId, ProxyId>> found, overlapping;
        list.find_pairs([&](ProxyId one, ProxyId other) {
            EXPECT_TRUE(found.insert(std::minmax(one, other)).second) << one << " and " << other << " are found twice";
        });
        for (auto one = expected.begin(); one != expected.end(); ++one)
            for (auto other = std::next(one); other != expected.end(); ++other)
                if (one->second.overlaps(other->second))
                    overlapping.insert({one->first, other->first});
        EXPECT_EQ(found, overlapping);
    }

    void expect_kept() const
    {
        std::map<ProxyId, FloatBox> kept;
        for (std::size_t i = 0; i < list.size(); ++i)
            kept[list[i].proxy] = list[i].box;
        EXPECT_TRUE(kept == expected);
        EXPECT_EQ(list.empty(), expected.empty());
    }

    Random random{1};
    BoxList list;
    std::map<ProxyId, FloatBox> expected;
};

TEST_F(BoxListTest, FindsWhatOverlapsWhateverComesAndGoes)
{
    for (int step = 0; step < 20000; ++step)
    {
        // Grows to some hundred and shrinks again, time after time.
        const auto id = static_cast<ProxyId>(random.index(150));
        if (expected.count(id) == 0 || random.chance(0.3))
            put(id, random_box());
        else if (random.chance(step / 2000 % 2 == 0 ? 0.2 : 0.95))
            remove(id);
        ASSERT_NO_FATAL_FAILURE(expect_found(random_box())) << step;
        ASSERT_FALSE(HasFailure());
        if (step % 100 == 0)
        {
            expect_kept();
            expect_pairs_found();
        }
    }
}

TEST_F(BoxListTest, NoBoxOverlapsOnePlaceThatIsFree)
{
    for (ProxyId id = 0; id < 9; ++id)
    {
        expect_found(everywhere);
        expect_pairs_found();
        put(id, random_box());
    }
    for (ProxyId id : {8u, 0u, 4u, 7u, 1u, 5u, 6u, 2u, 3u})
    {
        expect_found(everywhere);
        remove(id);
    }
    expect_found(everywhere);
    expect_kept();
}

TEST_F(BoxListTest, IsEmptyWhenCleared)
{
    put(3, random_box());
    list.clear();
    expected.clear();
    expect_kept();
    expect_found(everywhere);
    put(3, random_box());
    expect_kept();
}
} // namespace
} // namespace ode_predictive_space
