#include "ode_predictive_space/broadphase/index/envelope_index.h"

#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "tests/broadphase/support/pairs.h"
#include "tests/broadphase/support/proxies.h"

namespace ode_predictive_space
{
namespace
{
// An index over random predictions, and which of them are in it.
class IndexWorld
{
public:
    IndexWorld(std::size_t count, double spread, double idle_share)
        : random_(count), spread_(spread), idle_share_(idle_share)
    {
        for (std::size_t i = 0; i < count; ++i)
            store_.add();
        idle_.resize(count);
    }

    // New predictions for some proxies. Some of these are in the index already.
    void update(std::size_t count)
    {
        std::set<ProxyId> chosen;
        while (chosen.size() < count)
            chosen.insert(static_cast<ProxyId>(random_.index(store_.size())));
        batch_.assign(chosen.begin(), chosen.end());
        for (ProxyId id : batch_)
            predict(id);
        present_.insert(chosen.begin(), chosen.end());
        enter(batch_, random_.chance(0.5) ? count : random_.index(count + 1));
    }

    void remove_some()
    {
        for (ProxyId id = 0; id < store_.size(); ++id)
            if (random_.chance(0.1))
            {
                index_.remove(store_, id);
                EXPECT_EQ(store_.records[id].placement.shelf, Shelf::none);
                present_.erase(id);
            }
    }

    void clear()
    {
        index_.clear(store_);
        present_.clear();
    }

    // As after the last part of a scene that was predicted in parts.
    void rebuild() { index_.rebuild(store_, {}, idle_, now_); }

    void pass_time()
    {
        ++now_;
        // As in the tick, no horizon is outlived.
        std::vector<ProxyId> expired;
        for (ProxyId id : present_)
            if (store_.remaining(id, now_) <= 0)
                expired.push_back(id);
        for (ProxyId id : expired)
            predict(id);
        enter(expired, expired.size());
    }

    // Those that the last update found.
    void expect_pairs_of_batch() const
    {
        const IdSet in_batch = as_set(batch_);
        const Pairs pairs = sorted_pairs(found_);
        ASSERT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end()) << "a pair is found twice";
        for (const auto &[first, second] : pairs)
        {
            ASSERT_TRUE(first != second && (in_batch.contains(first) || in_batch.contains(second)));
            ASSERT_TRUE(present_.count(first) == 1 && present_.count(second) == 1);
            ASSERT_FALSE(idle_.contains(first) || idle_.contains(second));
        }
        for (ProxyId first : present_)
            for (ProxyId second : present_)
                if (first < second && (in_batch.contains(first) || in_batch.contains(second)) &&
                    !idle_.contains(first) && !idle_.contains(second) &&
                    store_.swept_box(first, now_).overlaps(store_.swept_box(second, now_)))
                {
                    ASSERT_TRUE(std::binary_search(pairs.begin(), pairs.end(), std::make_pair(first, second)));
                }
    }

    void expect_query()
    {
        const FloatBox box = random_.box(spread_, 1);
        std::vector<ProxyId> found;
        index_.query(box, [&](ProxyId id) { found.push_back(id); });
        std::sort(found.begin(), found.end());
        ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
        for (ProxyId id : found)
            ASSERT_EQ(present_.count(id), 1u);
        for (ProxyId id : present_)
            if (store_.swept_box(id, now_).overlaps(box))
            {
                ASSERT_TRUE(std::binary_search(found.begin(), found.end(), id));
            }
    }

    void expect_shelves() const
    {
        ASSERT_TRUE(index_.consistent());
        for (ProxyId id = 0; id < store_.size(); ++id)
        {
            const Shelf shelf = store_.records[id].placement.shelf;
            if (present_.count(id) == 0)
            {
                ASSERT_EQ(shelf, Shelf::none);
                continue;
            }
            const bool bounded = store_.swept_box(id, now_).bounded();
            const bool listed = !bounded || store_.size() <= tuning::small_scene;
            ASSERT_EQ(store_.records[id].placement.unbounded, !bounded);
            ASSERT_EQ(shelf, idle_.contains(id) && bounded   ? Shelf::idle
                             : listed                        ? Shelf::list
                             : store_.records[id].kind.still ? Shelf::still
                                                             : Shelf::moving);
        }
    }

private:
    void enter(const std::vector<ProxyId> &batch, std::size_t single)
    {
        found_.clear();
        index_.update(store_, swept(batch), as_set(batch), idle_, now_, single, found_);
    }

    IdSet as_set(const std::vector<ProxyId> &ids) const
    {
        IdSet set;
        set.resize(store_.size());
        for (ProxyId id : ids)
            set.insert(id);
        return set;
    }

    std::vector<SweptProxy> swept(const std::vector<ProxyId> &ids) const
    {
        std::vector<SweptProxy> result;
        for (ProxyId id : ids)
            result.push_back({id, store_.swept_box(id, now_)});
        return result;
    }

    void predict(ProxyId id)
    {
        ProxyStore made;
        add_random_proxy(made, random_, spread_, now_);
        if (random_.chance(0.03))
        {
            made.records[0].kind.still = true;
            made.records[0].prediction.low[random_.index(3)] = -std::numeric_limits<float>::infinity();
        }
        made.records[0].placement = store_.records[id].placement;
        store_.paths[id] = made.paths[0];
        store_.records[id] = made.records[0];
        random_.chance(idle_share_) ? idle_.insert(id) : idle_.erase(id);
    }

    Random random_;
    double spread_, idle_share_;
    Tick now_ = 0xfffffff0u;
    ProxyStore store_;
    IdSet idle_;
    EnvelopeIndex index_;
    std::vector<ProxyId> batch_;
    std::vector<CandidatePair> found_;
    std::set<ProxyId> present_;
};

void enter(EnvelopeIndex &index, ProxyStore &store, ProxyId id)
{
    IdSet in_batch, idle;
    in_batch.resize(store.size());
    idle.resize(store.size());
    in_batch.insert(id);
    std::vector<CandidatePair> found;
    index.update(store, {{id, store.swept_box(id, 0)}}, in_batch, idle, 0, 1, found);
}

class AnyIndex : public testing::TestWithParam<double>
{};

TEST_P(AnyIndex, FindsWhatBruteForceFindsWhateverIsUpdated)
{
    for (std::size_t count : {2, 10, 40, 200})
    {
        IndexWorld world(count, 1.5, GetParam());
        for (int step = 0; step < 150; ++step)
        {
            // One by one, some, most and all.
            world.update(std::max<std::size_t>(1, count * static_cast<std::size_t>(step % 5) / 4));
            ASSERT_NO_FATAL_FAILURE(world.expect_shelves());
            ASSERT_NO_FATAL_FAILURE(world.expect_pairs_of_batch());
            for (int query = 0; query < 5; ++query)
                ASSERT_NO_FATAL_FAILURE(world.expect_query());
            if (step % 7 == 0)
                world.remove_some();
            if (step % 70 == 69)
                world.clear();
            if (step % 11 == 0)
                world.rebuild();
            world.pass_time();
            ASSERT_NO_FATAL_FAILURE(world.expect_shelves());
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EnvelopeIndex, AnyIndex, testing::Values(0, 0.2),
                         [](const auto &info) { return info.param > 0 ? "some_idle" : "none_idle"; });

TEST(EnvelopeIndex, KeepsWhatNoTreeCanHoldInAList)
{
    ProxyStore store;
    EnvelopeIndex index;
    const ProxyId ball = add_still_proxy(store, {0, 0, 0}, 1, 0);
    const ProxyId floor = add_still_proxy(store, {0, 0, 0}, 1, 0);
    store.records[floor].prediction.low[2] = -std::numeric_limits<float>::infinity();
    const ProxyId lost = add_still_proxy(store, {0, 0, std::numeric_limits<double>::quiet_NaN()}, 1, 0);
    for (std::size_t i = 0; i < tuning::small_scene; ++i)
        store.add();
    for (ProxyId id : {ball, floor, lost})
        enter(index, store, id);
    EXPECT_EQ(store.records[ball].placement.shelf, Shelf::still);
    EXPECT_EQ(store.records[floor].placement.shelf, Shelf::list);
    EXPECT_EQ(store.records[lost].placement.shelf, Shelf::list);
    std::vector<ProxyId> found;
    index.query({{0, 0, -100}, {1, 1, -99}}, [&](ProxyId id) { found.push_back(id); });
    EXPECT_EQ(found, (std::vector<ProxyId>{floor, lost}));
    index.remove(store, floor);
    store.records[floor].prediction.low[2] = -1;
    enter(index, store, floor);
    EXPECT_EQ(store.records[floor].placement.shelf, Shelf::still) << "it has become finite";
}

TEST(EnvelopeIndex, KeepsAllInTheListWhileTheyAreFew)
{
    ProxyStore store;
    EnvelopeIndex index;
    auto add = [&](const Vector3 &place) {
        const ProxyId id = add_still_proxy(store, place, 1, 0);
        enter(index, store, id);
        return id;
    };
    const ProxyId first = add({0, 0, 0});
    EXPECT_EQ(store.records[first].placement.shelf, Shelf::list);
    while (store.size() < tuning::small_scene)
        add({10, 0, 0});
    EXPECT_EQ(store.records[first].placement.shelf, Shelf::list);
    add({10, 0, 0});
    EXPECT_EQ(store.records[first].placement.shelf, Shelf::still) << "the scene has outgrown the list";
    std::vector<ProxyId> found;
    index.query({{0, 0, 0}, {1, 1, 1}}, [&](ProxyId id) { found.push_back(id); });
    EXPECT_EQ(found, std::vector<ProxyId>{first});
}

TEST(EnvelopeIndex, RemovingWhatIsNotInItDoesNothing)
{
    ProxyStore store;
    EnvelopeIndex index;
    const ProxyId id = add_still_proxy(store, {0, 0, 0}, 1, 0);
    index.remove(store, id);
    enter(index, store, id);
    index.remove(store, id);
    index.remove(store, id);
    EXPECT_EQ(store.records[id].placement.shelf, Shelf::none);
    EXPECT_TRUE(index.consistent());
}
} // namespace
} // namespace ode_predictive_space
