// Delivery of the hand's impulses to the scene, and prediction of the touched bodies.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_MOTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_MOTION_H

#include "ode_predictive_space/haptics/contact/nearby_geom.h"
#include "ode_predictive_space/haptics/loop/island_roll_out.h"
#include "ode_predictive_space/haptics/loop/motion_forecast.h"
#include "ode_predictive_space/haptics/touch_sensor.h"

namespace ode_predictive_space::haptics
{
/// An impulse of a tick at tau in the step from a to a + h goes to this step with the weight 1 - (tau - a) / h, and to
/// the next one with the rest. So a free body is exact at the ends of steps, and no impulse is lost. A late impulse,
/// from before a, gets a weight above 1 and a negative rest.
class SceneMotion
{
public:
    SceneMotion(TouchSensor &sensor, double stiffness);

    void receive(const Impulse &impulse) { waiting_.push_back(impulse); }

    /// Adds forces to the bodies for the step of length h that begins at a, both in s.
    void push(double a, double h);

    /// Compares the program's step with the prediction.
    /// @param drew_numbers only dWorldQuickStep() with constraints draws ODE's random numbers.
    void note_step(bool drew_numbers);

    /// Whether the program's steps agree with the predictions. After deviations in a row, constant velocities are predicted.
    bool repeats() const { return deviations_ < most_deviations; }

    /// Whether the program's steps do more or less than ODE's: they deviate although no connected body was left out.
    bool steps_otherwise() const { return deviations_of_whole_ >= most_deviations; }

    void push_all(double h);

    /// Predicts the motion of the touched surfaces. After the program's collide(), before its advance().
    /// @param period s; of the program's rate. @param affordable maximum number of steps in a period.
    void predict(double time, double period, int affordable, MotionForecast &forecast);

    /// Moves a body without a forecast by its remaining impulses of the next step.
    void push_rest(NearbyGeom &geom) const;

    /// The number of steps, each with a collision, in a period of the program's rate. It never decreases.
    int steps_per_period() const { return steps_per_period_; }

private:
    using Pushes = std::array<BodyImpulse, MotionForecast::tried_pushes>;

    struct Touched
    {
        dBodyID body;
        Touch touch;
        Vector3 centre; ///< m; of mass
        Quaternion orientation;
        Eigen::Matrix<double, 6, 6> inertia;         ///< mass and moments of inertia, the world's frame
        Eigen::Matrix<double, 6, 6> inverse_inertia; ///< of it
        Pushes pushes;                               ///< of 1 N s
        Eigen::Matrix<double, 6, MotionForecast::tried_pushes> wrenches; ///< of the pushes
        BodyMotion predicted;                                            ///< in the next step, without the hand
    };

    using Course = MotionForecast::Course<BodyMotion>;
    using Courses = std::array<Course, MotionForecast::most_touches>;

    static constexpr int most_deviations = 5; ///< in a row

    void push_now(const std::vector<Impulse> &impulses, double h);
    void find_touched(MotionForecast &forecast);
    static Touched touched_of(dBodyID body, const Touch &touch);
    static Pushes pushes_on(const Touched &touched);
    static BodyMotion motion_of(const Touched &touched);
    bool moved_otherwise(const Touched &touched) const;
    std::vector<BodyImpulse> rest_of_impulses() const;
    void choose_steps(IslandRollOut &island, double period, int affordable);
    double fastest_spring() const;
    Courses try_out(IslandRollOut &island, const std::vector<BodyImpulse> &impulses, double h) const;
    void find_response(IslandRollOut &island, std::size_t pushed, const std::vector<BodyImpulse> &rest,
                       const Courses &free, double h, MotionForecast &forecast);
    BodyMotion limited(const BodyMotion &found, const BodyMotion &free, std::size_t seen, std::size_t pushed) const;
    double last_impulse_on(std::uintptr_t object) const;
    bool is_one_awake() const;

    TouchSensor &sensor_;
    double stiffness_; ///< N/m
    std::vector<Impulse> waiting_;
    std::vector<Impulse> rest_; ///< parts of the last step's impulses for the next one
    std::vector<Impulse> last_; ///< pushed in the last step
    std::vector<ForceShare> shares_;
    std::vector<Touched> touched_;
    std::uint64_t received_ = 0;
    int steps_per_period_ = 1;
    double predicted_step_ = 0;   ///< s
    int deviations_ = 0;          ///< consecutive steps that deviated
    int deviations_of_whole_ = 0; ///< those of roll-outs of all connected bodies
    int steps_needed_ = 1;        ///< by the last measurement
    bool has_joints_ = false;     ///< of the last roll-out
    bool is_whole_ = true;        ///< the last roll-out had all connected bodies
    bool quick_ = true;           ///< the program seems to use dWorldQuickStep()
};
} // namespace ode_predictive_space::haptics

#endif
