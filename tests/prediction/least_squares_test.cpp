#include "ode_predictive_space/prediction/least_squares.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

using namespace ode_predictive_space;

namespace
{
// Its time 0 is that of the newest sample.
const Path known_path = {Vector3(1, -2, 3), Vector3(0.5, 0.25, -0.125), Vector3(-0.02, 0.01, 0.04)};

std::vector<Sample> samples_of(const Path &path, const std::vector<double> &ages, double newest_time = 0)
{
    std::vector<Sample> samples;
    for (const double age : ages)
        samples.push_back({newest_time - age, path.at(-age)});
    return samples;
}

FittedPath fit(const std::vector<Sample> &samples)
{
    return fit_path(samples.data(), static_cast<int>(samples.size()));
}

void expect_same(const Path &path, const Path &expected, double tolerance)
{
    EXPECT_LT((path.position - expected.position).norm(), tolerance);
    EXPECT_LT((path.velocity - expected.velocity).norm(), tolerance);
    EXPECT_LT((path.acceleration - expected.acceleration).norm(), tolerance);
}

// Mean distance between the known path and one fitted to `count` noisy samples, where the newest is.
double mean_error_with_noise(int count, double noise)
{
    std::mt19937_64 engine(51);
    std::normal_distribution<double> shake(0, noise);
    const int trials = 2000;
    double sum = 0;
    for (int trial = 0; trial < trials; ++trial)
    {
        std::vector<Sample> samples;
        for (int age = count - 1; age >= 0; --age)
            samples.push_back(
                {-double(age), known_path.at(-age) + Vector3(shake(engine), shake(engine), shake(engine))});
        sum += (fit(samples).path.position - known_path.position).norm();
    }
    return sum / trials;
}
} // namespace

TEST(LeastSquares, recovers_a_path_of_second_degree)
{
    const FittedPath fitted = fit(samples_of(known_path, {7, 6, 5, 4, 3, 2, 1, 0}));
    expect_same(fitted.path, known_path, 1e-13);
    EXPECT_LT(fitted.residual, 1e-13);
}

TEST(LeastSquares, takes_up_to_max_samples)
{
    std::vector<double> ages;
    for (int age = max_samples - 1; age >= 0; --age)
        ages.push_back(age);
    expect_same(fit(samples_of(known_path, ages)).path, known_path, 1e-13);
}

TEST(LeastSquares, three_samples_are_met_exactly)
{
    const FittedPath fitted = fit(samples_of(known_path, {2, 1, 0}));
    expect_same(fitted.path, known_path, 1e-13);
    EXPECT_LT(fitted.residual, 1e-14);
}

TEST(LeastSquares, irregular_times)
{
    expect_same(fit(samples_of(known_path, {100, 41, 40, 3.5, 0.25, 0})).path, known_path, 1e-11);
    expect_same(fit(samples_of(known_path, {1e4, 1, 0})).path, known_path, 1e-7);
}

TEST(LeastSquares, times_far_from_zero)
{
    expect_same(fit(samples_of(known_path, {5, 4, 2, 1, 0}, 4e9)).path, known_path, 1e-12);
    expect_same(fit(samples_of(known_path, {5, 4, 2, 1, 0}, -4e9)).path, known_path, 1e-12);
}

TEST(LeastSquares, far_from_the_origin)
{
    Path far = known_path;
    far.position += Vector3(1e6, -1e6, 1e6);
    expect_same(fit(samples_of(far, {5, 4, 3, 2, 1, 0})).path, far, 1e-8);
}

TEST(LeastSquares, two_samples_give_a_line)
{
    const FittedPath fitted = fit({{10, Vector3(1, 1, 1)}, {14, Vector3(3, 1, -3)}});
    expect_same(fitted.path, {Vector3(3, 1, -3), Vector3(0.5, 0, -1), Vector3::Zero()}, 1e-14);
    EXPECT_LT(fitted.residual, 1e-14);
}

TEST(LeastSquares, one_sample_gives_a_still_point)
{
    const FittedPath fitted = fit({{10, Vector3(1, 2, 3)}});
    expect_same(fitted.path, {Vector3(1, 2, 3), Vector3::Zero(), Vector3::Zero()}, 1e-14);
    EXPECT_EQ(fitted.residual, 0);
}

TEST(LeastSquares, residual_is_the_root_mean_square_distance)
{
    // Alternating by 1 to either side: four samples' best parabola leaves a cubic of (-1, 3, -3, 1) / 20 times 8.
    const FittedPath fitted =
        fit({{0, Vector3(-1, 0, 0)}, {1, Vector3(1, 0, 0)}, {2, Vector3(-1, 0, 0)}, {3, Vector3(1, 0, 0)}});
    const double remainder = 8.0 / 20;
    EXPECT_NEAR(fitted.residual, remainder * std::sqrt((1 + 9 + 9 + 1) / 4.0), 1e-14);
}

TEST(LeastSquares, is_the_best_of_all_paths)
{
    const std::vector<Sample> samples = {{0, Vector3(0, 3, 1)},
                                         {1, Vector3(2, 1, 0)},
                                         {3, Vector3(1, 1, 5)},
                                         {4, Vector3(7, 0, 2)},
                                         {6, Vector3(3, 2, 2)}};
    const auto error = [&samples](const Path &path) {
        double sum = 0;
        for (const Sample &sample : samples)
            sum += (sample.position - path.at(sample.time - samples.back().time)).squaredNorm();
        return sum;
    };
    const FittedPath fitted = fit(samples);
    EXPECT_NEAR(std::sqrt(error(fitted.path) / samples.size()), fitted.residual, 1e-13);
    for (Vector3 Path::*member : {&Path::position, &Path::velocity, &Path::acceleration})
        for (int axis = 0; axis < 3; ++axis)
            for (const double change : {-1e-3, 1e-3})
            {
                Path other = fitted.path;
                (other.*member)[axis] += change;
                EXPECT_GT(error(other), error(fitted.path));
            }
}

TEST(LeastSquares, noise_is_averaged_out)
{
    // The newest end of a parabola fitted to n samples has a variance of about 9 / n.
    const double noise = 1e-3;
    const double with_3 = mean_error_with_noise(3, noise);
    const double with_8 = mean_error_with_noise(8, noise);
    const double with_16 = mean_error_with_noise(16, noise);
    EXPECT_LT(with_8, 0.95 * with_3);
    EXPECT_LT(with_16, 0.85 * with_8);
    EXPECT_NEAR(mean_error_with_noise(16, noise / 10), with_16 / 10, 1e-3 * with_16);
}
