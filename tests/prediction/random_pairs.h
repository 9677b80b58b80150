// Random pairs of envelopes of many kinds, most of them about to meet or to miss each other by little.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_PREDICTION_RANDOM_PAIRS_H
#define ODE_PREDICTIVE_SPACE_TESTS_PREDICTION_RANDOM_PAIRS_H

#include <cstdint>
#include <random>

#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
enum class PairKind
{
    still,
    slow,
    fast,
    head_on,
    grazing,
    corner,
    braking,
    free_fall,
    curved,
    big_and_small,
    far_from_origin,
    growing_faster_than_moving, ///< A < 0
    growing_as_moving,          ///< A = 0, exactly
    tangential,
};
constexpr int pair_kinds = 14;

struct EnvelopePair
{
    Envelope first;
    Envelope second;
    double duration;
};

class RandomPairs
{
public:
    explicit RandomPairs(std::uint64_t seed) : engine_(seed) {}

    EnvelopePair make(PairKind kind);

private:
    struct Encounter;

    double uniform(double low, double high);
    double log_uniform(double low, double high);
    double nearly_one();
    double sign() { return uniform(-1, 1) < 0 ? -1 : 1; }
    Vector3 direction();
    Vector3 perpendicular(const Vector3 &to);
    Envelope envelope(double radius);
    void draw_encounter(PairKind kind, const EnvelopePair &pair, Encounter &encounter);
    void draw_corner(const EnvelopePair &pair, Encounter &encounter);

    std::mt19937_64 engine_;
};
} // namespace ode_predictive_space

#endif
