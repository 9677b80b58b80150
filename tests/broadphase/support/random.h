// Random numbers and boxes for tests. They depend on the seed alone.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_RANDOM_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_RANDOM_H

#include <cstdint>
#include <random>

#include "ode_predictive_space/broadphase/base/float_box.h"

namespace ode_predictive_space
{
class Random
{
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double uniform(double low, double high)
    {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }

    std::size_t index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

    bool chance(double probability) { return uniform(0, 1) < probability; }

    Vector3 vector(double half)
    {
        const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
        return {x, y, z};
    }

    std::uint64_t bits() { return engine_(); }

    /// A box with its centre within `spread` of the origin and sides up to `size`.
    FloatBox box(double spread, double size)
    {
        const Vector3 centre = vector(spread);
        const Vector3 half = 0.5 * vector(size).cwiseAbs();
        return FloatBox::around(Box(centre - half, centre + half));
    }

private:
    std::mt19937_64 engine_;
};
} // namespace ode_predictive_space

#endif
