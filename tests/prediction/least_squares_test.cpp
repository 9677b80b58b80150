#include "ode_predictive_space/prediction/least_squares.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

using namespace ode_predictive_space;

namespace
{
// Time 0 is that of the newest sample.
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

} // namespace

TEST(LeastSquares, times_far_from_zero)
{
    expect_same(fit(samples_of(known_path, {5, 4, 2, 1, 0}, 4e9)).path, known_path, 1e-12);
    expect_same(fit(samples_of(known_path, {5, 4, 2, 1, 0}, -4e9)).path, known_path, 1e-12);
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
