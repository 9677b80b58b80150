#include "ode_predictive_space/prediction/path.h"

#include <gtest/gtest.h>

#include "tests/prediction/random_pairs.h"

using namespace ode_predictive_space;

namespace
{
const Path example_path = {Vector3(1, 2, 3), Vector3(4, 5, 6), Vector3(2, 0, -2)};
} // namespace

TEST(Path, is_of_second_degree)
{
    EXPECT_EQ(example_path.at(0), Vector3(1, 2, 3));
    EXPECT_EQ(example_path.at(2), Vector3(13, 12, 11));
    EXPECT_EQ(example_path.at(-1), Vector3(-2, -3, -4));
}

TEST(Path, advanced_is_the_same_curve)
{
    const Path later = example_path.advanced(3);
    EXPECT_EQ(later.at(0), example_path.at(3));
    EXPECT_EQ(later.at(2), example_path.at(5));
    EXPECT_EQ(later.at(-3), example_path.at(0));
    EXPECT_EQ(later.velocity, Vector3(10, 5, 0));
}

TEST(Path, relative_path_is_seen_from_the_first)
{
    const Path other = {Vector3(10, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 4)};
    const Path relative = relative_path(example_path, other);
    for (const double t : {0.0, 1.0, 2.5})
        EXPECT_EQ(relative.at(t), other.at(t) - example_path.at(t));
}

TEST(Path, chord_error_is_the_largest_distance_from_the_chord_at_equal_times)
{
    RandomPairs random(31);
    for (int i = 0; i < 1000; ++i)
    {
        const EnvelopePair pair = random.make(PairKind::curved);
        const Path &path = pair.second.path;
        const double T = pair.duration;
        const auto distance_from_chord = [&](double m) -> double {
            return (path.at(m * T) - (1 - m) * path.position - m * path.at(T)).norm();
        };
        const double error = chord_error(path.acceleration, T);
        const double rounding = 1e-13 * size_of_terms(path, T).sum();
        EXPECT_NEAR(distance_from_chord(0.5), error, rounding);
        for (int k = 0; k <= 10; ++k)
            EXPECT_LE(distance_from_chord(0.1 * k), error + rounding);
    }
}

TEST(Path, size_of_terms_does_not_cancel)
{
    const Path back_to_zero = {Vector3(8, 0, -1), Vector3(-4, 0, 0), Vector3(0, 2, 0)};
    EXPECT_EQ(back_to_zero.at(2).x(), 0);
    EXPECT_EQ(size_of_terms(back_to_zero, 2), Vector3(16, 8, 1));
}
