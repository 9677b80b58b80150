#include "ode_predictive_space/prediction/history.h"

#include <gtest/gtest.h>

using namespace ode_predictive_space;

namespace
{
const Path known = {Vector3(1, -2, 3), Vector3(0.5, 0.25, -0.125), Vector3(-0.02, 0.01, 0.04)};

// A history of `known` from tick `from` on; time 0 of the path is at tick `origin`.
History remembered(std::uint32_t from, int count, std::uint32_t origin)
{
    History history;
    for (std::uint32_t tick = from; count > 0; ++tick, --count)
        history.add(tick, known.at(static_cast<std::int32_t>(tick - origin)));
    return history;
}

void expect_same(const Path &path, const Path &expected)
{
    EXPECT_LT((path.position - expected.position).norm(), 1e-11);
    EXPECT_LT((path.velocity - expected.velocity).norm(), 1e-11);
    EXPECT_LT((path.acceleration - expected.acceleration).norm(), 1e-11);
}
} // namespace

TEST(History, remembers_the_last_samples_only)
{
    // Samples beyond the capacity are elsewhere, and must not enter the fit.
    History history;
    for (std::uint32_t tick = 0; tick < 5; ++tick)
        history.add(tick, Vector3(1000, 1000, 1000));
    for (std::uint32_t tick = 5; tick < 5 + History::capacity; ++tick)
        history.add(tick, known.at(tick));
    EXPECT_EQ(history.count(), int{History::capacity});
    expect_same(history.fit().path, known.advanced(4 + History::capacity));
    EXPECT_LT(history.fit().residual, 1e-11);
}

TEST(History, second_position_in_a_tick_replaces_the_first)
{
    History history = remembered(10, 4, 13);
    history.add(13, known.at(0) + Vector3(5, 5, 5));
    EXPECT_EQ(history.count(), 4);
    history.add(13, known.at(0));
    EXPECT_EQ(history.count(), 4);
    expect_same(history.fit().path, known);

    History full = remembered(0, 20, 19);
    full.add(19, known.at(0));
    EXPECT_EQ(full.count(), int{History::capacity});
    expect_same(full.fit().path, known);
}
