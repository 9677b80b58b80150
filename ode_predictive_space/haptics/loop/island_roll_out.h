// What the scene around a touch would do, with and without a push: tried out, and undone.

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
/// An impulse on a body, at the end of an arm from its centre of mass: m and N s, the world's frame.
struct BodyImpulse
{
    dBodyID body;
    Vector3 arm;
    Vector3 impulse;
};

/// Steps the bodies that hang together with some touched ones by joints and contacts, by ODE's own stepper and with the joints that
/// there are, then puts all back: poses, velocities, forces, joints' feedback, ODE's random numbers. Other bodies of the scene do not take
/// part. Of a large island, the bodies nearest to the touched ones are stepped, counted in joints between them, up to most_ends. The bodies
/// that these are joined to move on at constant velocity. What it cannot put back: callbacks of moved bodies are called; a body that hangs together with a
/// touched one does not fall asleep.
///
/// Used from the scene's thread, after the program has made its contact joints and before it steps the world.
class IslandRollOut
{
public:
    /// @param touched dynamic bodies of one world, at least one.
    /// @param quick whether to step by dWorldQuickStep(), else by dWorldStep().
    IslandRollOut(const std::vector<dBodyID> &touched, bool quick);

    ~IslandRollOut();
    IslandRollOut(const IslandRollOut &) = delete;
    IslandRollOut &operator=(const IslandRollOut &) = delete;

    /// Steps several times from where all is now, then puts the bodies back there.
    ///
    /// @param impulses given in the first step; those on bodies that do not take part are left out. @param look called after each step, with its number from 1 on.
    void run(std::size_t steps, double dt, const std::vector<BodyImpulse> &impulses,
             const std::function<void(std::size_t)> &look);

    /// rad/s; of the fastest swing of a body by the forces of the joints that hang it up, such as a rope's. Steps that are longer than
    /// 2 / that make ODE itself unstable.
    double fastest_swing(double dt);

    /// Bodies are added as long as all of them together have fewer ends of joints than this; a contact between two bodies has two. The
    /// cost of dWorldStep() grows with the cube of the number of joints.
    static constexpr int most_ends = 60, most_ends_by_quick_step = 150;

    /// Whether a joint holds one of the bodies, contacts included.
    bool has_joints() const { return has_joints_; }

    /// Whether one of the bodies is in contact with something.
    bool has_contacts() const { return has_contacts_; }

    /// Whether two of the bodies are in contact with each other.
    bool is_stacked() const { return is_stacked_; }

private:
    /// Of a body, to be restored.
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
    int ends_ = 0;                 ///< of the joints of these
    std::vector<dJointID> joints_; ///< those that last
    std::vector<AtEnd> undo_;      ///< what was done to bodies and joints so that no others are stepped
    unsigned long seed_;
    bool has_joints_ = false;
    bool has_contacts_ = false;
    bool is_stacked_ = false;
};
} // namespace ode_predictive_space::haptics

#endif
