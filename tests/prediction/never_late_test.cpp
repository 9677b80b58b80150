// The prediction against the true first contact, for more than a million random pairs and each measure of proximity.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "ode_predictive_space/prediction/proximity.h"
#include "tests/prediction/first_contact.h"
#include "tests/prediction/random_pairs.h"
#include "tests/support/effort.h"

using namespace ode_predictive_space;

namespace
{
constexpr int pairs_of_a_kind = of_cases(75000);
static_assert(pairs_of_a_kind * pair_kinds >= of_cases(1000000), "a million pairs for each measure");

// The distance by which the chord makes predictions early: a correct one need not be earlier.
double sphere_slack(const EnvelopePair &pair)
{
    const double T = pair.duration;
    return 2 * sphere_chord_error(pair.first, pair.second, T) +
           0.25 * (pair.first.deviation + pair.second.deviation).c * T * T;
}

double box_slack(const EnvelopePair &pair, int axis)
{
    const double T = pair.duration;
    const double bend = std::abs(pair.first.path.acceleration[axis] - pair.second.path.acceleration[axis]);
    return 0.125 * (2 * bend + 2 * (pair.first.deviation + pair.second.deviation).c) * T * T;
}

double size(const EnvelopePair &pair)
{
    const Vector3 terms =
        size_of_terms(pair.first.path, pair.duration) + size_of_terms(pair.second.path, pair.duration);
    return terms.sum() + pair.first.radius + pair.second.radius +
           (pair.first.deviation + pair.second.deviation).at(pair.duration);
}

// The spheres must not be farther apart than the chords' errors explain.
void expect_not_needlessly_early_by_spheres(const EnvelopePair &pair, double predicted)
{
    const double reach = size(pair);
    const Polynomial P = sphere_polynomial(pair.first, pair.second, pair.duration, sphere_slack(pair));
    EXPECT_LE(P.at(predicted / pair.duration), 1e-12 * reach * reach);
}

void expect_not_needlessly_early_by_boxes(const EnvelopePair &pair, double predicted)
{
    const std::array<Polynomial, 6> gaps = box_gaps(pair.first, pair.second, pair.duration);
    for (int side = 0; side < 6; ++side)
        EXPECT_LE(gaps[side].at(predicted / pair.duration), box_slack(pair, side / 2) + 1e-12 * size(pair));
}

template <typename Property> void for_all_kinds(std::uint64_t seed, int count, Property property)
{
    for (int kind = 0; kind < pair_kinds; ++kind)
    {
        RandomPairs random(seed + kind);
        for (int i = 0; i < count; ++i)
        {
            property(random.make(static_cast<PairKind>(kind)));
            ASSERT_FALSE(testing::Test::HasFailure()) << "kind " << kind << ", seed " << seed + kind << ", pair " << i;
        }
    }
}

void expect_never_late(std::uint64_t seed, TimeOfProximity &predict,
                       std::optional<Real> first_contact(const Envelope &, const Envelope &, double),
                       void expect_not_early(const EnvelopePair &, double))
{
    std::size_t encounters = 0;
    for_all_kinds(seed, pairs_of_a_kind, [&](const EnvelopePair &pair) {
        const auto predicted = predict(pair.first, pair.second, pair.duration);
        const auto contact = first_contact(pair.first, pair.second, pair.duration);
        EXPECT_TRUE(!contact || (predicted && *predicted <= *contact * pair.duration));
        if (predicted)
            expect_not_early(pair, *predicted);
        encounters += contact.has_value();
    });
    EXPECT_GT(encounters, static_cast<std::size_t>(of_cases(200000)));
}
} // namespace

TEST(NeverLate, time_of_proximity_of_spheres)
{
    expect_never_late(1000, sphere_time_of_proximity, first_sphere_contact, expect_not_needlessly_early_by_spheres);
}

TEST(NeverLate, time_of_proximity_of_boxes)
{
    expect_never_late(2000, box_time_of_proximity, first_box_contact, expect_not_needlessly_early_by_boxes);
}

TEST(NeverLate, time_in_halves)
{
    double earlier = 0, closer = 0;
    for_all_kinds(2500, 20000, [&](const EnvelopePair &pair) {
        const auto check = [&](TimeOfProximity &time, std::optional<Real> contact) {
            const auto whole = time(pair.first, pair.second, pair.duration);
            const auto halves = time_in_halves(time, pair.first, pair.second, pair.duration, 4);
            EXPECT_TRUE(!contact || (halves && *halves <= *contact * pair.duration));
            EXPECT_TRUE(whole || !halves) << "what is apart by the whole horizon stays apart";
            if (!contact || *contact == 0)
                return;
            earlier += static_cast<double>(*contact) - *whole / pair.duration;
            closer += static_cast<double>(*contact) - *halves / pair.duration;
        };
        check(sphere_time_of_proximity, first_sphere_contact(pair.first, pair.second, pair.duration));
        check(box_time_of_proximity, first_box_contact(pair.first, pair.second, pair.duration));
    });
    EXPECT_LT(closer, 0.1 * earlier) << "the error of chords is a small part of what it was";
}

TEST(NeverLate, when_there_is_no_chord_error_the_prediction_is_exact)
{
    // With a straight relative path and a deviation that does not bend, the quartic is the paper's quadratic.
    for_all_kinds(3000, 2000, [](EnvelopePair pair) {
        pair.second.path.acceleration = pair.first.path.acceleration;
        pair.first.deviation.c = pair.second.deviation.c = 0;
        const auto predicted = sphere_time_of_proximity(pair.first, pair.second, pair.duration);
        const auto contact = first_sphere_contact(pair.first, pair.second, pair.duration);
        if (contact && *contact > 0)
        {
            // Rounding may make it earlier where the polynomial is flat: the spheres graze or hardly approach each other.
            Polynomial P = sphere_polynomial(pair.first, pair.second, pair.duration);
            P.coefficient[0] -= 1e-13 * size(pair) * size(pair);
            EXPECT_LE(static_cast<double>(*first_not_positive(P)), *predicted / pair.duration + 1e-12);
        }
    });
}
