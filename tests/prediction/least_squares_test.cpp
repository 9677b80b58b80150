#include "ode_predictive_space/prediction/least_squares.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

using namespace ode_predictive_space;

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
    const FittedPath fitted = fit_path(samples.data(), static_cast<int>(samples.size()));
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
