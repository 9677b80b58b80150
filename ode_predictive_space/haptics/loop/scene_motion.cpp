#include "ode_predictive_space/haptics/loop/scene_motion.h"

#include "ode_predictive_space/haptics/contact/ode_vector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::size_t nodes = MotionForecast::nodes;
constexpr double least_test = 1e-3; // N s; the response to a smaller push is noise

/// Angular frequency times step; ODE is unstable from 2 on.
constexpr double most_swing = 1.2;

/// As above for a body in contact, on the spring between it and the hand. Contact joints belong to one step, so a
/// roll-out is valid while the hand moves the body little in a step. With longer steps the rendered friction is up to
/// 1.7 times that of a box on a floor, and 0.7 times that of a stack.
constexpr double most_spring = 0.5;
constexpr double most_spring_of_stack = 0.25;

/// s; with QuickStep, a body in contact jumps by up to 1.75 g times the squared step: at 4 ms and 500 N/m, 5 % of 2.8 N.
constexpr double longest_quick_step = 0.004;

constexpr int most_steps = 16; // per period
constexpr double fall = 9.81;  // m/s^2; a deviation below a quarter of free fall is ignored

double norm_of(const BodyMotion &motion, const Eigen::Matrix<double, 6, 6> &inertia)
{
    return std::sqrt(std::max(0.0, motion.dot(inertia * motion)));
}
} // namespace

SceneMotion::SceneMotion(TouchSensor &sensor, double stiffness) : sensor_(sensor), stiffness_(stiffness) {}

void SceneMotion::push(double a, double h)
{
    last_.swap(rest_);
    rest_.clear();
    const auto first_later =
        std::find_if(waiting_.begin(), waiting_.end(), [&](const Impulse &impulse) { return impulse.time >= a + h; });
    for (auto impulse = waiting_.begin(); impulse != first_later; ++impulse)
    {
        const double later = std::clamp((impulse->time - a) / h, -1.0, 1.0);
        Impulse part = *impulse;
        part.impulse = (1 - later) * impulse->impulse;
        last_.push_back(part);
        part.impulse = later * impulse->impulse;
        rest_.push_back(part);
        received_ = impulse->number;
    }
    waiting_.erase(waiting_.begin(), first_later);
    push_now(last_, h);
}

void SceneMotion::push_now(const std::vector<Impulse> &impulses, double h)
{
    shares_.clear();
    for (const Impulse &impulse : impulses)
        shares_.push_back({impulse.object, Vector3::Zero(), impulse.impulse / h, 0, impulse.arm});
    sensor_.push(shares_);
}

void SceneMotion::push_all(double h)
{
    push_now(rest_, h);
    push_now(waiting_, h);
    rest_.clear();
    waiting_.clear();
}

void SceneMotion::predict(double time, double period, int affordable, MotionForecast &forecast)
{
    forecast.time = time;
    forecast.last_included = received_;
    forecast.node_length = period / steps_per_period_;
    find_touched(forecast);
    if (touched_.empty())
        return;
    std::vector<dBodyID> bodies;
    for (const Touched &touched : touched_)
        bodies.push_back(touched.body);
    IslandRollOut island(bodies, quick_);
    has_joints_ = island.has_joints();
    is_whole_ = island.is_whole();
    choose_steps(island, period, affordable);
    const double h = period / steps_per_period_;
    predicted_step_ = h;
    forecast.node_length = h;
    const std::vector<BodyImpulse> rest = rest_of_impulses();
    const Courses free = try_out(island, rest, h);
    for (std::size_t i = 0; i < touched_.size(); ++i)
    {
        touched_[i].predicted = free[i][1];
        MotionForecast::Place &place = forecast.places[i];
        place.free = free[i];
        for (std::size_t node = 0; node <= nodes && !repeats(); ++node)
            place.free[node] = static_cast<double>(node) * h * place.velocity;
    }
    for (std::size_t i = 0; i < touched_.size(); ++i)
        find_response(island, i, rest, free, h, forecast);
}

void SceneMotion::note_step(bool drew_numbers)
{
    quick_ = drew_numbers || (quick_ && !(has_joints_ && is_one_awake()));
    const std::vector<Touched> touched = std::exchange(touched_, {});
    if (!last_.empty() || touched.empty())
        return;
    const auto surprises = [this](const Touched &each) { return moved_otherwise(each); };
    const bool deviates = std::any_of(touched.begin(), touched.end(), surprises);
    deviations_ = deviates ? deviations_ + 1 : 0;
    deviations_of_whole_ = deviates && is_whole_ ? deviations_of_whole_ + 1 : 0;
}

bool SceneMotion::moved_otherwise(const Touched &touched) const
{
    if (sensor_.body_of(touched.touch.object) != touched.body)
        return false;
    const Vector3 moved = motion_of(touched).head<3>();
    const Vector3 predicted = touched.predicted.head<3>();
    const double error = (moved - predicted).norm();
    return error > 0.25 * fall * predicted_step_ * predicted_step_ &&
           error > 0.5 * std::max(moved.norm(), predicted.norm());
}

/// Whether a touched body is enabled: otherwise a step has no constraints and does not reveal the stepper.
bool SceneMotion::is_one_awake() const
{
    return std::any_of(touched_.begin(), touched_.end(), [&](const Touched &touched) {
        return sensor_.body_of(touched.touch.object) == touched.body && dBodyIsEnabled(touched.body) != 0;
    });
}

/// The deepest touches of bodies that a push moves.
void SceneMotion::find_touched(MotionForecast &forecast)
{
    touched_.clear();
    forecast.count = 0;
    std::vector<const Touch *> by_depth;
    for (const Touch &touch : sensor_.touches())
        by_depth.push_back(&touch);
    std::sort(by_depth.begin(), by_depth.end(),
              [](const Touch *a, const Touch *b) { return a->depth != b->depth ? a->depth > b->depth : a < b; });
    for (const Touch *const each : by_depth)
    {
        const Touch &touch = *each;
        if (touched_.size() == MotionForecast::most_touches)
            return;
        const dBodyID body = sensor_.body_of(touch.object);
        if (body != nullptr && dBodyIsKinematic(body) == 0 &&
            (touched_.empty() || dBodyGetWorld(body) == dBodyGetWorld(touched_.front().body)))
        {
            touched_.push_back(touched_of(body, touch));
            const Touched &touched = touched_.back();
            MotionForecast::Place &place = forecast.places[forecast.count++];
            place.touch = touch;
            place.velocity << from_ode(dBodyGetLinearVel(body)), from_ode(dBodyGetAngularVel(body));
            place.combination =
                touched.wrenches.completeOrthogonalDecomposition().solve(Eigen::Matrix<double, 6, 6>::Identity());
        }
    }
}

/// The number of steps never decreases, because joint forces come and go. It needs two measurements, because a single
/// one may be that of a blow. Stability has priority; accuracy gets as many steps as there is time for.
void SceneMotion::choose_steps(IslandRollOut &island, double period, int affordable)
{
    double steps = std::ceil(island.fastest_swing(period / steps_per_period_) * period / most_swing);
    if (island.has_contacts())
    {
        const double most = island.is_stacked() ? most_spring_of_stack : most_spring;
        const double for_spring = fastest_spring() * period / most;
        const double for_quick = quick_ ? period / longest_quick_step : 1;
        steps = std::max(steps, std::min<double>(affordable, std::ceil(std::max(for_spring, for_quick))));
    }
    const int needed = static_cast<int>(std::clamp<double>(steps, 1, most_steps));
    steps_per_period_ = std::max(steps_per_period_, std::min(needed, steps_needed_));
    steps_needed_ = needed;
}

double SceneMotion::fastest_spring() const
{
    double square = 0;
    for (const Touched &touched : touched_)
    {
        const ImpulseWrench push = touched.wrenches.col(0);
        const double stiffness = touched.touch.material ? touched.touch.material->stiffness : stiffness_;
        square = std::max(square, stiffness * push.dot(touched.inverse_inertia * push));
    }
    return std::sqrt(square);
}

std::vector<BodyImpulse> SceneMotion::rest_of_impulses() const
{
    std::vector<BodyImpulse> impulses;
    for (const Impulse &impulse : rest_)
        if (const dBodyID body = sensor_.body_of(impulse.object))
            impulses.push_back({body, impulse.arm, -impulse.impulse});
    return impulses;
}

void SceneMotion::push_rest(NearbyGeom &geom) const
{
    for (const Impulse &impulse : rest_)
        if (impulse.object == geom.object())
            geom.push(-impulse.impulse, impulse.arm, 0);
}

SceneMotion::Touched SceneMotion::touched_of(dBodyID body, const Touch &touch)
{
    Touched touched;
    touched.body = body;
    touched.touch = touch;
    touched.centre = from_ode(dBodyGetPosition(body));
    touched.orientation = tool_state_of(body).orientation;
    const Mobility mobility = Mobility::of(body);
    touched.inverse_inertia.setZero();
    touched.inverse_inertia.topLeftCorner<3, 3>() = mobility.inverse_mass * Eigen::Matrix3d::Identity();
    touched.inverse_inertia.bottomRightCorner<3, 3>() = mobility.inverse_inertia;
    touched.inertia = touched.inverse_inertia.inverse();
    touched.pushes = pushes_on(touched);
    int column = 0;
    for (const BodyImpulse &push : touched.pushes)
        touched.wrenches.col(column++) << push.impulse, push.arm.cross(push.impulse);
    return touched;
}

/// Pushes along the normal, sideways for friction, and sideways without a moment for the turning normal of a round body.
SceneMotion::Pushes SceneMotion::pushes_on(const Touched &touched)
{
    const dBodyID body = touched.body;
    const Vector3 &arm = touched.touch.arm, centre = Vector3::Zero();
    const Vector3 along = -touched.touch.normal;
    const Vector3 aside = along.unitOrthogonal();
    const Vector3 across = along.cross(aside);
    return {
        {{body, arm, along}, {body, arm, aside}, {body, arm, across}, {body, centre, aside}, {body, centre, across}}};
}

BodyMotion SceneMotion::motion_of(const Touched &touched)
{
    const Eigen::AngleAxisd turn(tool_state_of(touched.body).orientation * touched.orientation.conjugate());
    BodyMotion motion;
    motion << from_ode(dBodyGetPosition(touched.body)) - touched.centre, turn.angle() * turn.axis();
    return motion;
}

SceneMotion::Courses SceneMotion::try_out(IslandRollOut &island, const std::vector<BodyImpulse> &impulses,
                                          double h) const
{
    Courses courses;
    for (Course &course : courses)
        course[0].setZero();
    island.run(nodes, h, impulses, [&](std::size_t node) {
        for (std::size_t i = 0; i < touched_.size(); ++i)
            courses[i][node] = motion_of(touched_[i]);
    });
    return courses;
}

/// The first push is as strong as the hand's last one. The others are added to it, as friction depends on the normal force.
void SceneMotion::find_response(IslandRollOut &island, std::size_t pushed, const std::vector<BodyImpulse> &rest,
                                const Courses &free, double h, MotionForecast &forecast)
{
    const Touched &touched = touched_[pushed];
    const double size = std::max(least_test, last_impulse_on(touched.touch.object));
    const Pushes &pushes = touched.pushes;
    Courses first;
    for (std::size_t i = 0; i < pushes.size(); ++i)
    {
        std::vector<BodyImpulse> impulses = rest;
        impulses.push_back({touched.body, pushes[0].arm, size * pushes[0].impulse});
        if (i > 0)
            impulses.push_back({touched.body, pushes[i].arm, size * pushes[i].impulse});
        const Courses found = try_out(island, impulses, h);
        const auto column = static_cast<int>(i);
        const BodyMotion unhindered = touched.inverse_inertia * touched.wrenches.col(column);
        for (std::size_t seen = 0; seen < touched_.size(); ++seen)
        {
            const Course &before = i == 0 ? free[seen] : first[seen];
            auto &course = forecast.response[pushed][seen];
            course[0].setZero();
            for (std::size_t node = 1; node <= nodes; ++node)
            {
                const BodyMotion moved = (found[seen][node] - before[node]) / size;
                course[node].col(column) = limited(moved, static_cast<double>(node) * h * unhindered, seen, pushed);
            }
        }
        if (i == 0)
            first = found;
    }
}

/// Constraints only reduce motion: measured by kinetic energy, the motion of a constrained body lies in the ball whose
/// diameter is the free motion. QuickStep's results can lie far outside.
BodyMotion SceneMotion::limited(const BodyMotion &found, const BodyMotion &free, std::size_t seen,
                                std::size_t pushed) const
{
    const bool own = touched_[seen].body == touched_[pushed].body;
    const double most = norm_of(free, touched_[pushed].inertia);
    const BodyMotion middle = own ? BodyMotion(0.5 * free) : BodyMotion(BodyMotion::Zero());
    const double radius = own ? 0.5 * most : most;
    const BodyMotion off = found - middle;
    const double distance = norm_of(off, touched_[seen].inertia);
    return distance > radius ? BodyMotion(middle + radius / distance * off) : found;
}

double SceneMotion::last_impulse_on(std::uintptr_t object) const
{
    double sum = 0;
    for (const Impulse &impulse : last_)
        sum += impulse.object == object ? impulse.impulse.norm() : 0;
    return sum;
}
} // namespace ode_predictive_space::haptics
