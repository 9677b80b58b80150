// How the scene answers when the hand pushes something: does it move, or is it held?

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PUSH_RESPONSE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PUSH_RESPONSE_H

#include "ode_predictive_space/haptics/force_shares.h"
#include "ode_predictive_space/haptics/mobility.h"

#include <cstdint>
#include <ode/objects.h>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Finds the mobility of what is touched. Mass and inertia are the body's; whether something else holds the body, ODE does not tell
/// (a wall, a floor, a hinge, another body), so that it is measured, for each touch along its normal: by how much the
/// velocity changed in a step, against what the impulses of the hand would have done to a free body. The yield is the slope of the
/// straight line through the last 10 ms or so, weighted. So what acts steadily, such as gravity or a motor, makes no
/// difference. Before the first push, what gravity could not do in the last step tells whether the body lies on something.
///
/// Used from the scene's thread: in each step look(), then note_pushes(). Does not allocate when it has seen as many touches.
class PushResponse
{
public:
    /// @param dt s; the length of the scene's steps, > 0.
    explicit PushResponse(double dt);

    /// A step begins: what the step before did is there to see.
    void begin();

    /// The mobility of a touched thing. @param body 0: of what has no body.
    Mobility look(const Touch &touch, dBodyID body);

    /// What is about to push, in the step that begins.
    /// @param shares the forces on the hand (N): the bodies get the opposite for a step.
    void note_pushes(const std::vector<ForceShare> &shares);

private:
    /// Of one touch: the weighted sums of a straight line, and what is needed for the next point of it.
    struct Record
    {
        std::uintptr_t object = 0;
        unsigned feature = 0;
        Mobility mobility;
        Vector3 point = Vector3::Zero();
        Vector3 velocity = Vector3::Zero(); ///< m/s; at the touch, before the step
        Vector3 pushed = Vector3::Zero();   ///< m/s; what the hand would have changed of that, were it free
        Vector3 gravity = Vector3::Zero();  ///< m/s; the same of gravity
        bool was_pushed = false;            ///< ever
        double weight = 0;
        double given = 0; ///< sum of what a free body would have got, and so on
        double got = 0;
        double given_given = 0;
        double given_got = 0;
    };

    const Record *before(const Touch &touch) const;
    void learn(Record &record, const Touch &touch) const;

    double dt_;
    double fading_; ///< from step to step, of a point's weight
    std::vector<Record> now_;
    std::vector<Record> before_;
};

/// Of a free body. Nothing moves a kinematic one.
Mobility free_mobility_of(dBodyID body);
} // namespace ode_predictive_space::haptics

#endif
