// Trial steps of the scene around a touch, with and without a push, which are undone.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_ISLAND_ROLL_OUT_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_ISLAND_ROLL_OUT_H

#include "ode_predictive_space/haptics/device/at_end.h"
#include "ode_predictive_space/haptics/touch_sensor.h"

#include <functional>
#include <ode/ode.h>
#include <unordered_set>
#include <vector>

namespace ode_predictive_space::haptics
{
/// An impulse (N s) on a body at the end of an arm (m) from its centre of mass, in the world's frame.
struct BodyImpulse
{
    dBodyID body;
    Vector3 arm;
    Vector3 impulse;
};

/// Steps the bodies that are connected with the touched ones by joints and contacts, by ODE's own stepper, then restores poses,
/// velocities, forces, joint feedback and ODE's random numbers. Other bodies are not stepped. A large island is reduced to the
/// bodies nearest to the touched ones, up to most_ends; the bodies beyond its border keep their velocities. Two effects remain:
/// callbacks of moved bodies are called, and a connected body does not fall asleep.
/// For the scene's thread, after the program has made its contact joints and before it steps the world.
class IslandRollOut
{
public:
    /// @param quick whether to step by dWorldQuickStep(), else by dWorldStep().
    IslandRollOut(const std::vector<dBodyID> &touched, bool quick);

    ~IslandRollOut();
    IslandRollOut(const IslandRollOut &) = delete;
    IslandRollOut &operator=(const IslandRollOut &) = delete;

    /// Steps several times from the present state, then restores it. The impulses act in the first step; those on other bodies
    /// are ignored. @param look called after each step, with its number from 1 on.
    void run(std::size_t steps, double dt, const std::vector<BodyImpulse> &impulses,
             const std::function<void(std::size_t)> &look);

    /// rad/s; the fastest oscillation of a body that hangs on joints, such as those of a rope. ODE is unstable with
    /// steps longer than 2 divided by it.
    double fastest_swing(double dt);

    /// Limits of the ends of joints of an island; a contact between two bodies has two. The cost of dWorldStep() grows
    /// with the cube of the number of joints.
    static constexpr int most_ends = 60, most_ends_by_quick_step = 150;

    bool has_joints() const { return has_joints_; }

    bool has_contacts() const { return has_contacts_; }

    bool is_stacked() const { return is_stacked_; }

    /// Whether no connected body was left out.
    bool is_whole() const { return is_whole_; }

private:
    struct State
    {
        dBodyID body;
        ToolState motion;
        Vector3 force;
        Vector3 torque;
        bool awake;
    };

    void add(dBodyID body);
    void add_connected();
    void note_joint(dJointID joint, dBodyID body);
    void hold_border(const std::vector<dBodyID> &border);
    void hold_others();
    void restore() const;
    template <typename Work> void at_end(const Work &work) { undo_.emplace_back(work); }

    bool quick_;
    std::unordered_set<dBodyID> known_;
    std::vector<State> states_;
    int ends_ = 0;                 ///< of their joints
    std::vector<dJointID> joints_; ///< joints with an anchor
    std::vector<AtEnd> undo_;      ///< restores bodies and joints
    unsigned long seed_;
    bool has_joints_ = false;
    bool has_contacts_ = false;
    bool is_stacked_ = false;
    bool is_whole_ = true;
};
} // namespace ode_predictive_space::haptics

#endif
