#include "demos/runs/world_run.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::worlds
{
namespace
{
TEST(Query, ProbesAndRaysAskInNoSpaceAndFindTheSameInEverySpace)
{
    const OdeSession ode;
    const WorldFactory factory({"query", 500, 1});
    std::vector<std::uint64_t> hashes;
    for (const SpaceKind kind : all_spaces())
    {
        const OwnedSpace space(make_space(kind, factory));
        const std::unique_ptr<World> scene = factory.make(space.get());
        ASSERT_EQ(scene->queries().size(), 40u);
        PairHash hash;
        PairList pairs;
        std::size_t found = 0;
        for (int tick = 0; tick < 100; ++tick)
        {
            scene->advance();
            pairs.clear();
            for (const dGeomID query : scene->queries())
            {
                ASSERT_EQ(dGeomGetSpace(query), nullptr);
                dSpaceCollide2(query, reinterpret_cast<dGeomID>(space.get()), &pairs, &PairList::collect);
            }
            pairs.drop_pairs_apart();
            hash.add_tick(hash_pairs(pairs.sorted()));
            found += pairs.size();
        }
        EXPECT_GT(found, 1000u);
        hashes.push_back(hash.value());
        EXPECT_EQ(hashes.back(), hashes.front()) << space_name(kind);
    }
}
} // namespace
} // namespace ode_predictive_space::worlds
