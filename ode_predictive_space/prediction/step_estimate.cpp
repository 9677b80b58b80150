#include "ode_predictive_space/prediction/step_estimate.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space
{
void StepEstimate::add(const Vector3 &displacement, const Vector3 &velocity_before, const Vector3 &velocity_after,
                       double ticks)
{
    const Vector3 mean = 0.5 * (velocity_before + velocity_after);
    const double speed_squared = mean.squaredNorm();
    const double change_squared = (velocity_after - velocity_before).squaredNorm();
    const double sample = displacement.dot(mean) / (speed_squared * ticks);
    if (!(change_squared < 0.25 * speed_squared) || !std::isfinite(sample) || !(sample > 0))
        return;
    // A sample close to the median changes the median by at most their difference.
    const bool agrees = count_ == remembered && std::abs(sample - step_) <= 1e-6 * step_;
    samples_[next_] = sample;
    next_ = (next_ + 1) % remembered;
    count_ = std::min(count_ + 1, remembered);

    if (agrees)
        return;
    std::array<double, remembered> sorted = samples_;
    std::nth_element(sorted.begin(), sorted.begin() + count_ / 2, sorted.begin() + count_);
    step_ = sorted[count_ / 2];
}
} // namespace ode_predictive_space
