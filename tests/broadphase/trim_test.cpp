#include <algorithm>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/base/memory.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
// With this number, unused memory is searched when one object is left, and must be searched again when none is.
constexpr std::size_t count = 24572;

enum class Order
{
    ascending,
    descending,
    shuffled
};

class Trim : public testing::TestWithParam<Order>
{
protected:
    Trim() : random(static_cast<std::uint64_t>(GetParam()) + 1) {}

    void add_objects(double spread)
    {
        world.broadphase = Broadphase();
        for (std::size_t i = 0; i < count; ++i)
        {
            Object object = i % 3 == 0 ? box(random.vector(spread), {0.1, 0.08, 0.05}, random.vector(0.001), false)
                                       : ball(random.vector(spread), 0.1, random.vector(0.001));
            object.enabled = i % 5 != 0;
            world.add(object);
        }
    }

    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
        {
            world.advance();
            world.tick();
        }
    }

    void remove_all_but(std::size_t left)
    {
        std::vector<ProxyId> ids = world.members();
        if (GetParam() == Order::descending)
            std::reverse(ids.begin(), ids.end());
        if (GetParam() == Order::shuffled)
            for (std::size_t i = ids.size() - 1; i > 0; --i)
                std::swap(ids[i], ids[random.index(i + 1)]);
        for (std::size_t i = 0; i + left < ids.size(); ++i)
            world.remove(ids[i]);
    }

    std::size_t bytes() const { return world.broadphase.bytes(); }

    Random random;
    World world;
};

std::string name_of_order(const testing::TestParamInfo<Order> &info)
{
    const char *const names[] = {"ascending", "descending", "shuffled"};
    return names[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Removed, Trim, testing::Values(Order::ascending, Order::descending, Order::shuffled),
                         name_of_order);

TEST(Memory, ScratchGivesBackWhatAOneOffSpikeTook)
{
    std::vector<int> scratch(1000000);
    clear_scratch(scratch);
    scratch.assign(10, 1);
    clear_scratch(scratch);
    EXPECT_LE(bytes_of(scratch), 100000u);
}

TEST_P(Trim, TheMemoryOfAllObjectsIsGivenBack)
{
    for (int ticks : {0, 1, 3, 30})
    {
        add_objects(8);
        run(ticks);
        const std::size_t full = bytes();
        EXPECT_GT(full, 100 * count);
        remove_all_but(0);
        EXPECT_LT(bytes(), 64u * 1024) << "of " << full << " after " << ticks << " ticks";
        EXPECT_EQ(world.violated_invariant(), "");
    }
}

TEST_P(Trim, AFewObjectsThatAreLeftKeepTheirPairs)
{
    add_objects(2);
    run(3);
    const std::size_t full = bytes();
    remove_all_but(100);
    EXPECT_TRUE(GetParam() != Order::descending || bytes() < full / 50) << "numbers in use are low";
    for (int ticks = 0; ticks < 20; ++ticks)
    {
        world.advance();
        ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping());
        ASSERT_EQ(world.violated_invariant(), "");
    }
    for (std::size_t i = 0; i < 200; ++i)
        world.add(ball(random.vector(1), 0.1, random.vector(0.001)));
    for (int ticks = 0; ticks < 20; ++ticks)
    {
        world.advance();
        ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping());
        ASSERT_EQ(world.violated_invariant(), "");
    }
}
} // namespace
} // namespace ode_predictive_space
