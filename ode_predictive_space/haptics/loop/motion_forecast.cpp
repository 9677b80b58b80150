#include "ode_predictive_space/haptics/loop/motion_forecast.h"

namespace ode_predictive_space::haptics
{
namespace
{
struct Moment
{
    Moment(double elapsed, double node_length)
    {
        const double nodes = std::max(0.0, elapsed / node_length);
        node = std::min(static_cast<std::size_t>(nodes), MotionForecast::nodes - 1);
        part = nodes - static_cast<double>(node);
    }

    std::size_t node; ///< the earlier one
    double part;      ///< fraction towards the later one; above 1 beyond the last
};

/// The index of the object's place whose normal agrees best with the force; the number of places for an unknown object.
std::size_t pushed_by(const Impulse &impulse, const MotionForecast &forecast)
{
    const auto along_normal = [&](std::size_t i) { return impulse.impulse.dot(forecast.places[i].touch.normal); };
    std::size_t found = forecast.count;
    for (std::size_t i = 0; i < forecast.count; ++i)
        if (forecast.places[i].touch.object == impulse.object &&
            (found == forecast.count || along_normal(i) > along_normal(found)))
            found = i;
    return found;
}

/// The wrench on the body, from an impulse on the hand.
ImpulseWrench wrench_of(const Impulse &impulse)
{
    ImpulseWrench wrench;
    wrench << -impulse.impulse, -impulse.arm.cross(impulse.impulse);
    return wrench;
}
} // namespace

bool MotionForecast::predicts(std::uintptr_t object) const
{
    const auto is_it = [object](const Place &place) { return place.touch.object == object; };
    return std::any_of(places.begin(), places.begin() + count, is_it);
}

Shifts MotionForecast::shifts(const std::vector<Impulse> &impulses, double now) const
{
    const double elapsed = now - time;
    const Moment at(elapsed, node_length);
    std::array<BodyMotion, most_touches> moved;
    std::array<BodyMotion, most_touches> velocity;
    for (std::size_t i = 0; i < count; ++i)
    {
        const Place &place = places[i];
        const BodyMotion step = place.free[at.node + 1] - place.free[at.node];
        moved[i] = place.free[at.node] + at.part * step - elapsed * place.velocity;
        velocity[i] = step / node_length - place.velocity;
    }
    for (const Impulse &impulse : impulses)
    {
        const std::size_t pushed = pushed_by(impulse, *this);
        if (impulse.number <= last_included || pushed == count)
            continue;
        const Eigen::Matrix<double, tried_pushes, 1> pushes = places[pushed].combination * wrench_of(impulse);
        const Moment since(now - impulse.time, node_length);
        for (std::size_t i = 0; i < count; ++i)
        {
            const Course<Response> &course = response[pushed][i];
            const BodyMotion before = course[since.node] * pushes;
            const BodyMotion step = course[since.node + 1] * pushes - before;
            moved[i] += before + since.part * step;
            velocity[i] += step / node_length;
        }
    }
    Shifts shifts;
    for (std::size_t i = 0; i < count; ++i)
        shifts[i] = {places[i].touch.object, moved[i].head<3>(), velocity[i].head<3>(), moved[i].tail<3>(),
                     velocity[i].tail<3>()};
    return shifts;
}
} // namespace ode_predictive_space::haptics
