#include "ode_predictive_space/broadphase/index/envelope_index.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/pairs.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
TightBox tight(const FloatBox &box)
{
    return TightBox::of(box);
}

class IndexWorld
{
public:
    IndexWorld(std::size_t count, double spread, double idle_share)
        : random_(count), spread_(spread), idle_share_(idle_share)
    {
        for (std::size_t i = 0; i < count; ++i)
            store_.add();
        idle_.resize(count);
        batch_.resize(count);
    }

    void update(std::size_t count)
    {
        batch_.clear();
        while (batch_.size() < count)
            batch_.add(static_cast<ProxyId>(random_.index(store_.size())));
        for (ProxyId id : batch_.ids())
            predict(id);
        present_.insert(batch_.ids().begin(), batch_.ids().end());
        found_.clear();
        swept_ = !index_.find_pairs(store_, batch_, idle_, found_);
        index_.put(store_, batch_);
    }

    bool swept() const { return swept_; }

    bool consistent() const { return index_.consistent(); }

    void remove_some()
    {
        for (ProxyId id = 0; id < store_.size(); ++id)
            if (random_.chance(0.1))
            {
                index_.remove(store_, id);
                EXPECT_EQ(store_.records[id].tree_kind, TreeKind::none);
                store_.places[id].forget_envelope();
                present_.erase(id);
            }
    }

    void clear()
    {
        index_.clear(store_);
        for (ProxyId id : present_)
            store_.places[id].forget_envelope();
        present_.clear();
    }

    void expect_pairs_of_batch() const
    {
        const Pairs pairs = sorted_pairs(found_);
        ASSERT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end()) << "a pair is found twice";
        Pairs expected;
        for (ProxyId first : present_)
            for (ProxyId second : present_)
                if (first < second && (batch_.contains(first) || batch_.contains(second)) && !idle_.contains(first) &&
                    !idle_.contains(second) && envelope(first).overlaps(envelope(second)))
                    expected.emplace_back(first, second);
        ASSERT_EQ(pairs, expected);
    }

    void expect_query()
    {
        index_.prepare(store_);
        ASSERT_TRUE(index_.is_prepared());
        const FloatBox box = random_.box(spread_, 1);
        std::vector<ProxyId> found, expected;
        index_.walk(BoxProbe(box), [&](ProxyId id) { found.push_back(id); });
        std::sort(found.begin(), found.end());
        for (ProxyId id : present_)
            if (envelope(id).overlaps(box))
                expected.push_back(id);
        ASSERT_EQ(found, expected);
    }

private:
    FloatBox envelope(ProxyId id) const { return store_.places[id].envelope(); }

    void predict(ProxyId id)
    {
        FloatBox box = random_.box(spread_, 0.5);
        if (random_.chance(0.03))
            box.low[random_.index(3)] = -float_infinity;
        store_.places[id].set_envelope(tight(box));
        random_.chance(idle_share_) ? idle_.insert(id) : idle_.erase(id);
    }

    Random random_;
    double spread_, idle_share_;
    ProxyStore store_;
    IdSet idle_;
    EnvelopeIndex index_;
    Batch batch_;
    std::vector<CandidatePair> found_;
    std::set<ProxyId> present_;
    bool swept_ = false;
};

class AnyIndex : public testing::TestWithParam<double>
{};

TEST_P(AnyIndex, FindsWhatBruteForceFindsWhateverIsUpdated)
{
    for (std::size_t count : {2, 10, 40, 300})
    {
        IndexWorld world(count, 1.5, GetParam());
        int sweeps = 0;
        for (int step = 0; step < 150; ++step)
        {
            world.update(std::max<std::size_t>(1, count * static_cast<std::size_t>(step % 5) / 4));
            sweeps += world.swept();
            ASSERT_TRUE(world.consistent());
            ASSERT_NO_FATAL_FAILURE(world.expect_pairs_of_batch());
            for (int query = 0; step % 3 != 0 && query < 5; ++query)
                ASSERT_NO_FATAL_FAILURE(world.expect_query());
            if (step % 7 == 0)
                world.remove_some();
            if (step % 70 == 69)
                world.clear();
            ASSERT_TRUE(world.consistent());
        }
        EXPECT_GE(sweeps, 90) << "half of them and more";
        EXPECT_LT(sweeps, count <= 2 ? 151 : 121) << "and not one of many";
    }
}

INSTANTIATE_TEST_SUITE_P(EnvelopeIndex, AnyIndex, testing::Values(0, 0.2),
                         [](const auto &info) { return info.param > 0 ? "some_idle" : "none_idle"; });

} // namespace
} // namespace ode_predictive_space
