#include "ode_predictive_space/prediction/track.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space
{
namespace
{
// Change of acceleration in a tick, relative to the longest step, above which a motion ends. Hands and motors change smoothly.
constexpr double other_motion = 0.1;
} // namespace

void Track::add(std::uint32_t tick, const SampledPose &pose)
{
    if (!pose.is_rigid)
        history_ = {};
    append(tick, pose);
}

void Track::append(std::uint32_t tick, const SampledPose &pose)
{
    const bool replaces = history_.count() > 0 && history_.newest_tick() == tick;
    if (history_.count() > 0 && !replaces && tick - history_.newest_tick() != 1)
        history_ = {};
    if (!replaces)
        std::copy_backward(rotations_.begin(), rotations_.end() - 1, rotations_.end());
    history_.add(tick, pose.pivot);
    rotations_[0] = pose.rotation;
    rounding_ = pose.rounding;
    if (!continues())
        history_.keep_newest();
}

// NaN and infinity never continue a motion.
bool Track::continues() const
{
    const int count = history_.count();
    if (count < 2)
        return true;
    const auto step = [&](int n) { return Vector3(history_.before_newest(n) - history_.before_newest(n + 1)); };
    const Vector3 last = step(0);
    if (count <= needed)
        return last.allFinite();
    const Vector3 change = (last - step(1)) - (step(1) - step(2));
    const double longest = std::max({last.norm(), step(1).norm(), step(2).norm()});
    return change.norm() <= other_motion * longest + 8 * rounding_;
}

bool Track::rests() const
{
    const auto equals_newest = [&](int n) {
        return history_.before_newest(n) == history_.before_newest(0) &&
               rotations_[static_cast<std::size_t>(n)] == rotations_[0];
    };
    return is_known() && equals_newest(1) && equals_newest(2);
}

Path Track::path() const
{
    const Vector3 &last = history_.before_newest(0), &before = history_.before_newest(1),
                  &first = history_.before_newest(2);
    return {last, 0.5 * (3 * last - 4 * before + first), last - 2 * before + first};
}

// If each of the three positions is off by e, path() is off by at most e (2 t^2 + 4 t + 1). This deviation is 0 at the newest
// position, and at least that from half a tick on.
Deviation Track::rounding() const
{
    return {0, 6 * rounding_, 2 * rounding_};
}

// When R becomes Q R, a point at distance 1 moves by at most |Q - 1|, the Frobenius norm of Q R - R divided by sqrt(2).
double Track::turning() const
{
    const double last = (rotations_[0] - rotations_[1]).squaredNorm(),
                 before = (rotations_[1] - rotations_[2]).squaredNorm();
    return std::sqrt(0.5 * std::max(last, before));
}
} // namespace ode_predictive_space
