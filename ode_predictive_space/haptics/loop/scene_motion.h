// The motion of what the hand touches: how the scene gets the hand's impulses, and what it will make of them.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_MOTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_MOTION_H

#include "ode_predictive_space/haptics/contact/nearby_geom.h"
#include "ode_predictive_space/haptics/loop/island_roll_out.h"
#include "ode_predictive_space/haptics/loop/motion_forecast.h"
#include "ode_predictive_space/haptics/touch_sensor.h"

namespace ode_predictive_space::haptics
{
/// An impulse of a tick at tau within the step from a to a + h goes to this step with the weight 1 - (tau - a) / h, and to the next one
/// with the rest. So a free body is at the ends of steps where it would be had it got each impulse at once, and nothing is lost. An
/// impulse that comes too late, from before a, gets a weight above 1 and takes back in the next step what was too much.
///
/// Used from the scene's thread.
class SceneMotion
{
public:
    /// @param stiffness N/m; of the force law, for what has no material of its own.
    SceneMotion(TouchSensor &sensor, double stiffness);

    /// To be pushed by the steps that it belongs to.
    void receive(const Impulse &impulse) { waiting_.push_back(impulse); }

    /// Forces on the bodies for the step of a length h that begins at a: both in s.
    void push(double a, double h);

    /// The program has stepped its world. Was it as foreseen?
    ///
    /// @param drew_numbers whether ODE's random numbers have gone on: only dWorldQuickStep() draws any, where there are constraints.
    void note_step(bool drew_numbers);

    /// Whether the program's steps are those of ODE alone. When several in a row were not, bodies are taken to go on with the velocities that
    /// they have.
    bool repeats() const { return surprises_ < most_surprises; }

    /// All that is left, for a step of a length h.
    void push_all(double h);

    /// Tries out what the touched surfaces will do. After the program's collide(), before its advance().
    ///
    /// @param period s; of the program's rate. @param affordable how many steps there is time for in a period.
    void foresee(const ContactModel &planes, double time, double period, int affordable, MotionForecast &forecast);

    /// A body that is not in the forecast goes by what it will get in the next step for what the hand got already.
    void push_rest(NearbyGeom &geom) const;

    /// How often the scene has to be stepped, and looked at, in a period of the program's rate. Never less than before.
    int steps_per_period() const { return steps_per_period_; }

private:
    using Pushes = std::array<BodyImpulse, MotionForecast::tried_pushes>;

    /// A body, and what it was when the scene was looked at.
    struct Touched
    {
        dBodyID body;
        Touch touch;
        Vector3 centre; ///< m; of mass
        Quaternion orientation;
        Eigen::Matrix<double, 6, 6> inertia;         ///< mass and moments of inertia, the world's frame
        Eigen::Matrix<double, 6, 6> inverse_inertia; ///< of it
        Pushes pushes;                               ///< that are tried, of 1 N s
        Eigen::Matrix<double, 6, MotionForecast::tried_pushes> wrenches; ///< of the pushes
        BodyMotion foreseen;                                             ///< in the next step, if the hand does nothing
    };

    using Course = MotionForecast::Course<BodyMotion>;
    using Courses = std::array<Course, MotionForecast::most_touches>;

    static constexpr int most_surprises = 5; ///< one after the other

    void push_now(const std::vector<Impulse> &impulses, double h);
    void find_touched(const ContactModel &planes, MotionForecast &forecast);
    static Touched touched_of(dBodyID body, const Touch &touch);
    static Pushes pushes_on(const Touched &touched);
    static BodyMotion motion_of(const Touched &touched);
    bool moved_otherwise(const Touched &touched) const;
    std::vector<BodyImpulse> rest_of_impulses() const;
    void choose_steps(IslandRollOut &island, double period, int affordable);
    double fastest_spring() const;
    Courses try_out(IslandRollOut &island, const std::vector<BodyImpulse> &impulses, double h) const;
    void find_response(IslandRollOut &island, std::size_t pushed, const std::vector<BodyImpulse> &rest, double h,
                       MotionForecast &forecast);
    BodyMotion limited(const BodyMotion &found, const BodyMotion &free, std::size_t seen, std::size_t pushed) const;
    double last_impulse_on(std::uintptr_t object) const;
    bool is_one_awake() const;

    TouchSensor &sensor_;
    double stiffness_; ///< N/m
    std::vector<Impulse> waiting_;
    std::vector<Impulse> rest_; ///< of the impulses of the last step: for the next one
    std::vector<Impulse> last_; ///< pushed in the last step
    std::vector<ForceShare> shares_;
    std::vector<Touched> touched_;
    std::uint64_t received_ = 0;
    int steps_per_period_ = 1;
    double foreseen_step_ = 0; ///< s
    int surprises_ = 0;        ///< steps in a row that were not as foreseen
    int steps_needed_ = 1;     ///< at the last look
    bool has_joints_ = false;  ///< what was tried out last
    bool quick_ = true;        ///< the program steps by dWorldQuickStep(), as far as is known
};
} // namespace ode_predictive_space::haptics

#endif
