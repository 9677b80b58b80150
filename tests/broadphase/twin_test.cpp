// Both implementations of the vector arithmetic give the same results, bit for bit: this file is compiled into two test
// programs, and the constants here are the same in both.

#include <cstring>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"
#include "ode_predictive_space/broadphase/schedule/schedule.h"
#include "tests/broadphase/support/pairs.h"
#include "tests/broadphase/support/proxies.h"

namespace ode_predictive_space
{
namespace
{
// FNV-1a.
class Hash
{
public:
    template <typename Value> void add(const Value &value)
    {
        unsigned char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        for (unsigned char byte : bytes)
            value_ = (value_ ^ byte) * 0x100000001b3u;
    }

    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

// Objects at random, some of them still.
class Gas
{
public:
    static constexpr Tick now = 1000;

    Gas()
    {
        Random random(1);
        for (ProxyId id = 0; id < 400; ++id)
        {
            add_random_proxy(store, random, 1.5, now - static_cast<Tick>(random.index(10)));
            Tick &until = store.records[id].prediction.until;
            until = std::max(until, now);
            swept.push_back({id, store.swept_box(id, now)});
        }
    }

    Pairs candidates() const
    {
        std::vector<CandidatePair> pairs;
        SortAndSweep().find_pairs(swept, pairs);
        return sorted_pairs(pairs);
    }

    ProxyStore store;
    std::vector<SweptProxy> swept;
};

TEST(Twin, CandidatesAreThoseOfBruteForce)
{
    const Gas gas;
    const Pairs expected = all_pairs(gas.swept.size(), [&](ProxyId first, ProxyId second) {
        return gas.swept[first].box.overlaps(gas.swept[second].box);
    });
    EXPECT_EQ(gas.candidates(), expected);
    EXPECT_GT(expected.size(), 1000u);
}

// A change of the formulas changes these numbers. They may be replaced when both programs agree on the new ones; the commit
// says what has changed.
TEST(Twin, BoxesAndTimesOfProximityAreTheSameToTheLastBit)
{
    const Gas gas;
    Hash boxes, times;
    for (const SweptProxy &swept : gas.swept)
        boxes.add(swept.box);
    std::size_t met = 0;
    for (const auto &[first, second] : gas.candidates())
        if (const auto interval = PairProximity(gas.store, first, Gas::now, ProximityTest::box).to(second))
        {
            ++met;
            times.add(interval->enter);
            times.add(interval->leave);
        }
    EXPECT_GT(met, 1000u);
    EXPECT_EQ(boxes.value(), 14820482238344193602u);
    EXPECT_EQ(times.value(), 2803957621360530826u);
}
} // namespace
} // namespace ode_predictive_space
