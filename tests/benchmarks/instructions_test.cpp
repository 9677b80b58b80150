#include "tests/benchmarks/instructions/callgrind_output.h"
#include "tests/benchmarks/instructions/counts.h"
#include "tests/benchmarks/instructions/motion_stream.h"
#include "tests/benchmarks/instructions/whole_counts.h"

#include <cmath>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
Count count(const std::string &scene, const std::string &space, double collide, double notices)
{
    Count result;
    result.scene = scene;
    result.objects = 100;
    result.ticks = 10;
    result.space = space;
    result.collide = collide;
    result.notices = notices;
    result.pairs = 7;
    result.pair_hash = "0123456789abcdef";
    return result;
}

TEST(CallgrindOutput, CallsAreAddedUpWithAllThatTheyCalled)
{
    const std::string dump =
        "events: Ir\nsummary: 9999\n\nfn=outer\n0 45\ncfn=collide\ncalls=3 0 \n0 5872\n"
        "cfn=collide_more\ncalls=1 0 \n0 100\nfn=other\n0 7\ncfi=a.cpp\ncfn=collide\ncalls=1 12\n14 28\n"
        "calls=2 0\n5 1000\ncfn=other\ncalls=1 0\n0 1\n";
    std::istringstream in(dump);
    EXPECT_EQ(costs_of_calls(in, "collide").instructions, 5872u + 28 + 1000);
    std::istringstream again(dump);
    EXPECT_EQ(costs_of_calls(again, "collide_more").instructions, 100u);
}

TEST(CallgrindOutput, WhatIsNotUnderstoodIsRefused)
{
    std::istringstream without("events: Ir\ncfn=other\ncalls=1 0\n0 1\n");
    EXPECT_THROW(costs_of_calls(without, "collide"), std::runtime_error);
    std::istringstream broken("events: Ir\ncfn=collide\ncalls=1 0\n+3\n");
    EXPECT_THROW(costs_of_calls(broken, "collide"), std::runtime_error);
    std::istringstream others("events: Ir Dr\ncfn=collide\ncalls=1 0\n0 1 5\n");
    EXPECT_THROW(costs_of_calls(others, "collide"), std::runtime_error);
}

TEST(CallgrindOutput, AFunctionNeedNotHaveBeenCalled)
{
    std::istringstream without("events: Ir\ncfn=other\ncalls=1 0\n0 1\n");
    EXPECT_FALSE(costs_of_any_calls(without, "collide"));
    std::istringstream with("events: Ir\ncfn=collide\ncalls=1 0\n0 7\n");
    EXPECT_EQ(costs_of_calls(with, "collide").instructions, 7u);
}

TEST(CallgrindOutput, MissesAreOfReadsAndWrites)
{
    std::istringstream in(
        "events: Ir Dr Dw I1mr D1mr D1mw ILmr DLmr DLmw\ncfn=collide\ncalls=1 0\n0 100 9 8 7 6 5 4 3 2\n"
        "cfn=collide\ncalls=1 0\n0 50 1 1 0 1\n");
    const Costs costs = costs_of_calls(in, "collide");
    EXPECT_EQ(costs.instructions, 150u);
    EXPECT_EQ(costs.first_level_misses, 6u + 5 + 1);
    EXPECT_EQ(costs.last_level_misses, 3u + 2) << "zeros at the end of a line are not written";
}

WholeCount whole_count(const std::string &scene, const std::string &space, const std::string &hash)
{
    WholeCount result;
    result.scene = scene;
    result.objects = 100;
    result.space = space;
    result.contacts_per_tick = 2;
    result.state_hash = hash;
    return result;
}

TEST(WholeCounts, ContendersMustComeToTheSameStates)
{
    std::vector<WholeCount> counts = {whole_count("mix", "predictive-box", "a"), whole_count("mix", "sap", "a"),
                                      whole_count("pile", "predictive-box", "b"), whole_count("pile", "sap", "b")};
    EXPECT_TRUE(same_states(counts));
    EXPECT_EQ(find(counts, "pile", 100, "sap"), &counts[3]);
    EXPECT_EQ(find(counts, "pile", 200, "sap"), nullptr);
    counts[3].state_hash = "a";
    EXPECT_FALSE(same_states(counts));
    counts[3].state_hash = "b";
    counts[3].contacts_per_tick = 3;
    EXPECT_FALSE(same_states(counts));
}

TEST(Counts, ARecordHoldsAllOfACount)
{
    const Count written = count("gas", "sap", 12.25, 0.5);
    const nlohmann::json records = {{{"scene", "gas"}, {"mean_us", 1}}, record_of(written)};
    const std::vector<Count> read = counts_in(records);
    ASSERT_EQ(read.size(), 1u) << "other records are passed over";
    EXPECT_EQ(record_of(read[0]), record_of(written));
    EXPECT_EQ(read[0].sum(), 12.75);
    EXPECT_THROW(counts_in(nlohmann::json{{"scene", "gas"}}), nlohmann::json::exception);
}

TEST(Counts, WhatIsKnownOfShortLivesAndCachesIsInTheRecord)
{
    Count written = count("many", "sap", 12, 1);
    EXPECT_FALSE(record_of(written).contains("life"));
    EXPECT_FALSE(record_of(written).contains("first_level_misses"));
    written.life = 100;
    written.bytes_per_geom = 64;
    written.misses = CacheMisses{3, 0.5};
    const nlohmann::json record = record_of(written);
    EXPECT_EQ(record.at("sum"), 113) << "with the life";
    EXPECT_EQ(record.at("last_level_misses"), 0.5);
    EXPECT_EQ(record_of(counts_in(nlohmann::json::array({record}))[0]), record);
}

TEST(Counts, TheBestOfOdeHasTheLeastSumInTheSameScene)
{
    const std::vector<Count> counts = {count("gas", "predictive-box", 1, 1), count("gas", "hash", 50, 1),
                                       count("gas", "sap", 20, 30), count("game", "quadtree", 2, 2),
                                       count("gas", "sweep", 3, 3)};
    EXPECT_EQ(best_of_ode(counts, counts[0]), &counts[2]);
    EXPECT_EQ(best_of_ode(counts, count("pile", "predictive-box", 1, 1)), nullptr);
}

TEST(Counts, ComparedIsWhatBothRunsHave)
{
    const std::vector<Count> before = {count("gas", "predictive-box", 100, 100),
                                       count("game", "predictive-box", 10, 10), count("gas", "sap", 1, 1)};
    const std::vector<Count> now = {count("game", "predictive-box", 40, 40), count("gas", "predictive-box", 50, 50),
                                    count("pile", "predictive-box", 1, 1)};
    const std::vector<CountPair> pairs = in_both(before, now);
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_EQ(pairs[0].ratio(), 4);
    EXPECT_EQ(pairs[1].ratio(), 0.5);
    const RatioSummary summary = summary_of(pairs);
    EXPECT_NEAR(summary.geometric_mean, std::sqrt(2.0), 1e-12);
    EXPECT_EQ(summary.largest, 4);
    EXPECT_EQ(summary.largest_in, "game 100");
    EXPECT_THROW(in_both(before, {count("pile", "sap", 1, 1)}), std::runtime_error);
}

TEST(Counts, RunsOfOtherTicksAreNotCompared)
{
    const Count before = count("gas", "sap", 1, 1);
    Count now = before;
    now.ticks = 11;
    EXPECT_THROW(in_both({before}, {now}), std::runtime_error);
    now = before;
    now.warm_up_ticks = 11;
    EXPECT_THROW(in_both({before}, {now}), std::runtime_error);
    now = before;
    now.seed = 11;
    EXPECT_THROW(in_both({before}, {now}), std::runtime_error);
}

TEST(Counts, OtherPairsAreSeenAndShown)
{
    const Count before = count("gas", "sap", 1, 1);
    Count now = before;
    EXPECT_TRUE(in_both({before}, {now})[0].same_pairs());
    now.pair_hash = "fedcba9876543210";
    EXPECT_FALSE(in_both({before}, {now})[0].same_pairs());
    std::ostringstream text;
    print(text, in_both({before}, {now}));
    EXPECT_NE(text.str().find("OTHERS"), std::string::npos) << text.str();
    EXPECT_NE(text.str().find("sap: geometric mean 1.0000, largest 1.0000 (gas 100)"), std::string::npos) << text.str();
}

TEST(MotionStream, MovesArriveAsTheyWereSent)
{
    std::FILE *file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    Move move;
    move.index = 5;
    move.rotation[11] = 0.25;
    move.angular_velocity[2] = -3;
    write_moves(file, {});
    write_moves(file, {Move(), move});
    std::rewind(file);
    EXPECT_TRUE(read_moves(file).empty());
    const std::vector<Move> moves = read_moves(file);
    ASSERT_EQ(moves.size(), 2u);
    EXPECT_EQ(moves[1].index, 5u);
    EXPECT_EQ(moves[1].rotation, move.rotation);
    EXPECT_EQ(moves[1].angular_velocity, move.angular_velocity);
    EXPECT_THROW(read_moves(file), std::runtime_error) << "it ends here";
    std::fclose(file);
}
} // namespace
} // namespace ode_predictive_space::benchmarks
