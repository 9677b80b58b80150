#include "ode_predictive_space/prediction/least_squares.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

namespace ode_predictive_space
{
FittedPath fit_path(const Sample *samples, int count)
{
    constexpr int max_terms = 3;
    const int terms = std::min(count, max_terms);
    const Sample &newest = samples[count - 1];
    // Times are scaled to [-1, 0], so that the columns of the system have similar sizes for any span of samples.
    const double span = count > 1 ? newest.time - samples[0].time : 1.0;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_samples, max_terms> powers(count, terms);
    Eigen::Matrix<double, Eigen::Dynamic, 3, 0, max_samples, 3> positions(count, 3);
    for (int i = 0; i < count; ++i)
    {
        const double time = (samples[i].time - newest.time) / span;
        double power = 1;
        for (int term = 0; term < terms; ++term, power *= time)
            powers(i, term) = power;
        positions.row(i) = (samples[i].position - newest.position).transpose();
    }
    const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, max_terms, 3> solution = powers.householderQr().solve(positions);

    FittedPath fitted;
    fitted.path.position = newest.position + solution.row(0).transpose();
    if (terms > 1)
        fitted.path.velocity = solution.row(1).transpose() / span;
    if (terms > 2)
        fitted.path.acceleration = 2 * solution.row(2).transpose() / (span * span);
    fitted.residual = std::sqrt((powers * solution - positions).squaredNorm() / count);
    return fitted;
}
} // namespace ode_predictive_space
