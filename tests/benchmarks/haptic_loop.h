// A haptic program in little: what happens between two readings of the device.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_HAPTIC_LOOP_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_HAPTIC_LOOP_H

#include "demos/runs/spaces.h"
#include "demos/worlds/probe_force.h"
#include "ode_predictive_space/haptics/hand_path.h"

namespace ode_predictive_space::benchmarks
{
/// What is inside the tick that must end in time.
enum class HapticTick
{
    collide, ///< device, dSpaceCollide(), contacts of the probe, force. The objects are moved between the ticks: it is the
             ///< part that the space answers for
    kinematic, ///< the same and the motion of the objects, which follow paths of their own
    stepped    ///< the same and dWorldQuickStep(): the objects are free bodies, and those that are touched are pushed
};

constexpr HapticTick all_haptic_ticks[] = {HapticTick::collide, HapticTick::kinematic, HapticTick::stepped};

/// "collide", "kinematic" or "quickstep".
std::string haptic_tick_name(HapticTick tick);

/// Gas with a probe: half of the objects still, the others fly; in their midst a hand moves a sphere through a cube of 2 m,
/// feels what it touches by a penalty force and pushes it back. The objects do not touch one another: only the probe's
/// contacts are looked for. The motion is the same in every space.
class HapticLoop
{
public:
    HapticLoop(worlds::SpaceKind kind, int objects, std::uint64_t seed, HapticTick tick);
    ~HapticLoop();
    HapticLoop(const HapticLoop &) = delete;
    HapticLoop &operator=(const HapticLoop &) = delete;

    /// Make one tick.
    ///
    /// @return its time of computing on this thread, in microseconds: what the machine does besides does not count.
    double tick();

    double force_sum() const { return force_sum_; } ///< of the amounts of all forces so far, N: same in every space
    std::size_t ticks_in_touch() const { return touches_; } ///< in which there was a force

private:
    static void near(void *loop, dGeomID first, dGeomID second);
    void read_device();
    void feel();

    worlds::OwnedSpace space_;               // before the objects, which are in it
    std::unique_ptr<worlds::World> objects_; // that the probe can touch
    HapticTick content_;
    haptics::HandPath hand_;
    dGeomID probe_;
    worlds::ProbeForce force_;
    std::vector<dGeomID> touched_; // by their boxes
    int ticks_ = 0;
    double force_sum_ = 0;
    std::size_t touches_ = 0;
};
} // namespace ode_predictive_space::benchmarks

#endif
