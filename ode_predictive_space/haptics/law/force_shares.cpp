#include "ode_predictive_space/haptics/law/force_shares.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double parallel = 1e-9; ///< square of the sine between vectors below which they count as parallel

double part_along(const Vector3 &a, const Vector3 &b)
{
    const double square = b.squaredNorm();
    return square > 0 ? a.dot(b) / square : 0;
}

/// The coefficients, 0 to 1, whose combination comes nearest to the given force: limits only shorten.
Eigen::Vector2d find_mix(const Vector3 &given, const Vector3 &requested, const Vector3 &before)
{
    const double ww = requested.squaredNorm();
    const double pp = before.squaredNorm();
    const double wp = requested.dot(before);
    const double determinant = ww * pp - wp * wp;
    const double gw = given.dot(requested);
    const double gp = given.dot(before);
    Eigen::Vector2d mix(gw * pp - gp * wp, gp * ww - gw * wp);
    if (determinant > parallel * ww * pp)
        return (mix / determinant).cwiseMax(0).cwiseMin(1);
    // Parallel forces: the present request has priority.
    mix[0] = std::clamp(part_along(given, requested), 0.0, 1.0);
    mix[1] = std::clamp(part_along(given - mix[0] * requested, before), 0.0, 1.0);
    return mix;
}

Vector3 sum(const std::vector<ForceShare> &shares)
{
    Vector3 total = Vector3::Zero();
    for (const ForceShare &share : shares)
        total += share.force;
    return total;
}
} // namespace

ForceSplit::ForceSplit()
{
    shares_.reserve(2 * touch_capacity); // of touches and former touches
    before_.reserve(2 * touch_capacity);
}

void ForceSplit::split(const std::vector<Touch> &touches, const TouchForces &requested, const Vector3 &given)
{
    std::swap(shares_, before_);
    shares_.clear();
    const Eigen::Vector2d mix = find_mix(given, sum_of(requested), sum(before_));
    for (std::size_t i = 0; i < touches.size(); ++i)
        shares_.push_back({touches[i].object, touches[i].point, mix[0] * requested[i], touches[i].id, touches[i].arm});
    for (std::size_t i = touches.size(); i < requested.size(); ++i)
    {
        const auto entry = static_cast<std::uint32_t>(i - touches.size());
        shares_.push_back({free_space, Vector3::Zero(), mix[0] * requested[i], entry, Vector3::Zero()});
    }
    for (const ForceShare &share : before_)
    {
        const Vector3 force = mix[1] * share.force;
        const auto is_same = [&](const ForceShare &now) {
            return now.object == share.object && now.touch == share.touch;
        };
        if (ForceShare *known = find_in(shares_, is_same))
            known->force += force;
        else if (!force.isZero(0))
            shares_.push_back({share.object, share.point, force, share.touch, share.arm});
    }
    add_rest(given);
}

// Adds the difference to a W + b P, from rounding or a controller's damping, to the largest share.
void ForceSplit::add_rest(const Vector3 &given)
{
    const auto most = std::max_element(shares_.begin(), shares_.end(), [](const ForceShare &a, const ForceShare &b) {
        return a.force.squaredNorm() < b.force.squaredNorm();
    });
    if (most == shares_.end())
        return;
    most->force += given - sum(shares_);
}
} // namespace ode_predictive_space::haptics
