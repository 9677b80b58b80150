#include "ode_predictive_space/haptics/loop/motion_forecast.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
void MotionForecast::begin(double time)
{
    count_ = 0;
    time_ = time;
}

void MotionForecast::set_nodes(std::size_t nodes, double node_length)
{
    nodes_ = nodes;
    node_length_ = node_length;
}

void MotionForecast::add(const Place &place, const PushWrenches &pushes)
{
    places_[count_] = place;
    places_[count_].combination =
        pushes.completeOrthogonalDecomposition().solve(Eigen::Matrix<double, 6, 6>::Identity());
    ++count_;
}

MotionForecast::Course<BodyMotion> MotionForecast::free_of_velocity(std::size_t touch) const
{
    Course<BodyMotion> course;
    for (std::size_t node = 0; node <= nodes_; ++node)
        course[node] = static_cast<double>(node) * node_length_ * places_[touch].velocity;
    return course;
}

MotionForecast::Moment MotionForecast::moment(double elapsed) const
{
    const double nodes = std::max(0.0, elapsed / node_length_);
    const auto node = std::min(static_cast<std::size_t>(nodes), nodes_ - 1);
    return {node, nodes - static_cast<double>(node)};
}

/// The place of the object whose normal the force had, as far as possible. @return count_ when there is none.
std::size_t MotionForecast::pushed_by(const Impulse &impulse) const
{
    std::size_t found = count_;
    for (std::size_t i = 0; i < count_; ++i)
        if (places_[i].touch.object == impulse.object &&
            (found == count_ ||
             impulse.impulse.dot(places_[i].touch.normal) > impulse.impulse.dot(places_[found].touch.normal)))
            found = i;
    return found;
}

void MotionForecast::add_response(const Impulse &impulse, double now, std::array<Motion, most_touches> &motions) const
{
    const std::size_t pushed = pushed_by(impulse);
    if (impulse.number <= last_included_ || pushed == count_)
        return;
    const Place &place = places_[pushed];
    const Vector3 centre = place.centre + (impulse.time - time_) * place.velocity.head<3>();
    ImpulseWrench wrench;
    wrench << -impulse.impulse, (centre - impulse.point).cross(impulse.impulse);
    const Eigen::Matrix<double, tried_pushes, 1> pushes = place.combination * wrench;
    const Moment since = moment(now - impulse.time);
    for (std::size_t i = 0; i < count_; ++i)
    {
        const Course<Response> &response = response_[pushed][i];
        const BodyMotion before = response[since.node] * pushes;
        const BodyMotion step = response[since.node + 1] * pushes - before;
        motions[i].moved += before + since.part * step;
        motions[i].velocity += step / node_length_;
    }
}

void MotionForecast::shift(const std::vector<Impulse> &impulses, double now, const ContactModel &planes,
                           ContactModel::Shifts &shifts) const
{
    std::array<Motion, most_touches> motions;
    const double elapsed = now - time_;
    const Moment at = moment(elapsed);
    for (std::size_t i = 0; i < count_; ++i)
    {
        const BodyMotion step = free_[i][at.node + 1] - free_[i][at.node];
        motions[i].moved = free_[i][at.node] + at.part * step - elapsed * places_[i].velocity;
        motions[i].velocity = step / node_length_ - places_[i].velocity;
    }
    for (const Impulse &impulse : impulses)
        add_response(impulse, now, motions);
    for (std::size_t i = 0; i < planes.count(); ++i)
    {
        shifts[i] = {};
        for (std::size_t place = 0; place < count_; ++place)
        {
            if (places_[place].touch.object == planes.touch(i).object)
            {
                const Motion &motion = motions[place];
                shifts[i] = {motion.moved.head<3>(), motion.velocity.head<3>(), motion.moved.tail<3>(),
                             motion.velocity.tail<3>(), places_[place].centre};
                break;
            }
        }
    }
}
} // namespace ode_predictive_space::haptics
