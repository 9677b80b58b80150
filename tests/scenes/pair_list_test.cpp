#include "demos/runs/pair_hash.h"
#include "demos/runs/spaces.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::worlds
{
namespace
{
TEST(PairHash, NoticesAMissingAnotherOrADoubledPair)
{
    const std::uint64_t hash = hash_pairs({{0, 1}, {2, 3}});
    EXPECT_NE(hash, hash_pairs({{0, 1}}));
    EXPECT_NE(hash, hash_pairs({{0, 1}, {2, 4}}));
    EXPECT_NE(hash, hash_pairs({{0, 3}, {1, 2}}));
    EXPECT_NE(hash, hash_pairs({{0, 1}, {2, 3}, {2, 3}}));
    EXPECT_NE(hash_pairs({}), hash_pairs({{2, 3}, {2, 3}})) << "two of the same do not cancel";
    EXPECT_NE(hash_pairs({}), hash_pairs({{0, 0}}));
}

class PairListTest : public testing::Test
{
protected:
    ~PairListTest() override { dSpaceDestroy(space_); }

    dGeomID box_at(double x, std::uint32_t index)
    {
        const dGeomID geom = dCreateBox(space_, 1, 1, 1);
        dGeomSetPosition(geom, x, 0, 0);
        set_geom_index(geom, index);
        return geom;
    }

    void collide()
    {
        list_.clear();
        dSpaceCollide(space_, &list_, &PairList::collect);
    }

    OdeSession ode_;
    dSpaceID space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    PairList list_;
};

TEST_F(PairListTest, DropsWhatTheSweepAndPruneSpaceRoundsTogether)
{
    box_at(0, 0);
    box_at(1 + 1e-9, 1); // a gap that single precision cannot resolve
    box_at(-1, 2);       // touches: closed intervals overlap
    collide();
    EXPECT_EQ(list_.size(), 2u) << "the sweep-and-prune space should report a pair that is 1e-9 apart";
    EXPECT_EQ(list_.drop_pairs_apart(), 1u);
    EXPECT_EQ(list_.sorted(), (std::vector<IndexPair>{{0, 2}}));
}
} // namespace
} // namespace ode_predictive_space::worlds
