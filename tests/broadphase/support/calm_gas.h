#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_CALM_GAS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_CALM_GAS_H

#include <cmath>

#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
/// Balls in uniform motion that bounce off the walls of a cube. Most have no near neighbour.
class CalmGas
{
public:
    explicit CalmGas(std::size_t count, std::uint64_t seed = 1)
        : random_(seed), half_(std::cbrt(0.4 * static_cast<double>(count)))
    {
        for (std::size_t i = 0; i < count; ++i)
            world.add(ball(random_.vector(half_), 0.1, random_.vector(0.001)));
    }

    void move()
    {
        world.advance();
        bounce();
    }

    Pairs tick()
    {
        move();
        return world.tick();
    }

    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
            tick();
    }

    void scatter()
    {
        for (ProxyId id : world.members())
            world.place(id, random_.vector(half_));
    }

    double objects() const { return static_cast<double>(world.members().size()); }
    std::uint64_t predictions() const { return world.broadphase.counters().repredictions; }

    World world;

private:
    void bounce()
    {
        for (ProxyId id : world.members())
            bounce(world.object(id));
    }

    void bounce(Object &object) const
    {
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(object.centre[axis]) > half_ && object.centre[axis] * object.displacement[axis] > 0)
                object.displacement[axis] = -object.displacement[axis];
        object.velocity = object.displacement / World::step;
    }

    Random random_;
    double half_;
};
} // namespace ode_predictive_space

#endif
