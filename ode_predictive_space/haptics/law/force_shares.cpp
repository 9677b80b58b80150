#include "ode_predictive_space/haptics/law/force_shares.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double parallel = 1e-9; ///< square of the sine between vectors below which they count as parallel

struct Mix
{
    double requested = 0;
    double before = 0;
};

/// How much of b is in a.
double part_along(const Vector3 &a, const Vector3 &b)
{
    const double square = b.squaredNorm();
    return square > 0 ? a.dot(b) / square : 0;
}

/// The combination of the two that comes nearest to what was given. Limits only shorten: neither part is more than 1.
Mix find_mix(const Vector3 &given, const Vector3 &requested, const Vector3 &before)
{
    const double ww = requested.squaredNorm();
    const double pp = before.squaredNorm();
    const double wp = requested.dot(before);
    const double determinant = ww * pp - wp * wp;
    Mix mix;
    if (determinant > parallel * ww * pp)
    {
        const double gw = given.dot(requested);
        const double gp = given.dot(before);
        mix.requested = std::clamp((gw * pp - gp * wp) / determinant, 0.0, 1.0);
        mix.before = std::clamp((gp * ww - gw * wp) / determinant, 0.0, 1.0);
    }
    else
    {
        // Of one direction: what is requested now comes first.
        mix.requested = std::clamp(part_along(given, requested), 0.0, 1.0);
        mix.before = std::clamp(part_along(given - mix.requested * requested, before), 0.0, 1.0);
    }
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
    shares_.reserve(usual_touches);
    before_.reserve(usual_touches);
}

void ForceSplit::split(const std::vector<Touch> &touches, const TouchForces &requested, const Vector3 &given)
{
    std::swap(shares_, before_);
    shares_.clear();
    const Mix mix = find_mix(given, sum_of(requested), sum(before_));
    for (std::size_t i = 0; i < touches.size(); ++i)
        shares_.push_back({touches[i].object, touches[i].point, mix.requested * requested[i], touches[i].feature});
    for (std::size_t i = touches.size(); i < requested.size(); ++i)
    {
        const auto entry = static_cast<unsigned>(i - touches.size());
        shares_.push_back({free_space, Vector3::Zero(), mix.requested * requested[i], entry});
    }
    for (const ForceShare &share : before_)
    {
        const Vector3 force = mix.before * share.force;
        const auto is_same = [&](const ForceShare &now) {
            return now.object == share.object && now.feature == share.feature;
        };
        if (ForceShare *known = find_in(shares_, is_same))
            known->force += force;
        else if (!force.isZero(0))
            shares_.push_back({share.object, share.point, force, share.feature});
    }
    add_rest(given);
}

// What rounding, or a controller's damping, adds to a W + b P: to the one that gives most.
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
