// The motion of a scene, noted and made again without what made it.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_REPLAY_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_REPLAY_H

#include "demos/runs/contender.h"
#include "demos/worlds/world.h"

#include <array>
#include <vector>

namespace ode_predictive_space::benchmarks
{
/// Where a body, or a geom without one, is after a tick in which it moved or was set to where it was, and how fast it is.
struct Move
{
    std::uint32_t index = 0; ///< the geom's number in the scene; of a body's geoms the one that ODE lists first
    std::array<dReal, 4> position{};
    std::array<dReal, 12> rotation{};
    std::array<dReal, 3> velocity{};
    std::array<dReal, 3> angular_velocity{};
};

/// The moves of some ticks.
using Motion = std::vector<std::vector<Move>>;

/// Runs a scene, with its contacts, and notes what moves. For scenes that make and destroy no geoms while they run.
class Recorder
{
public:
    explicit Recorder(const worlds::WorldFactory &factory);

    /// @throws std::logic_error for a scene that it is not for.
    Motion record(int ticks);

    /// Where everything was before the first tick.
    const std::vector<Move> &start() const { return start_; }

private:
    std::vector<Move> changes();
    void clean();

    std::unique_ptr<worlds::Contender> contender_; // before the scene, whose geoms are in its space
    std::unique_ptr<worlds::World> scene_;
    worlds::PairList list_;
    std::vector<Move> last_seen_; // by number
    std::vector<Move> start_;
};

/// A copy of the same scene that only moves as it is told: neither steps of a world nor contacts, but each geom that moved
/// is moved, and ODE tells the space so, exactly as a step of the world would.
class Replay
{
public:
    /// @param space gets the geoms and must outlive the replay; null: the geoms are in no space.
    Replay(const worlds::WorldFactory &factory, dSpaceID space);

    void make(const std::vector<Move> &moves);

    worlds::World &scene() { return *scene_; }

private:
    std::unique_ptr<worlds::World> scene_;
};
} // namespace ode_predictive_space::benchmarks

#endif
