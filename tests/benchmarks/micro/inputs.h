// What the micro-benchmarks work on: as many objects as asked for, at the density of the scene gas.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_MICRO_INPUTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_MICRO_INPUTS_H

#include <cmath>
#include <vector>

#include "ode_predictive_space/broadphase/base/float_box.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space::micro
{
/// Half the side of the room in which n objects of radius 0.1 m take 1 % of the volume, metres.
inline double half_room(std::size_t objects)
{
    return 0.5 * std::cbrt(static_cast<double>(objects) * 0.419);
}

/// An object of radius 0.1 m somewhere in the room, that flies at up to 1 mm per tick.
inline Envelope random_envelope(Random &random, double half)
{
    Envelope envelope;
    envelope.path = {random.vector(half), random.vector(0.001), random.vector(1e-6)};
    envelope.deviation = {0.002, 1e-4, 0};
    envelope.low = Vector3::Constant(-0.1);
    envelope.high = Vector3::Constant(0.1);
    envelope.radius = 0.1;
    return envelope;
}

/// Envelopes swept over this many ticks.
inline std::vector<SweptProxy> swept_boxes(std::size_t objects, double ticks)
{
    Random random(1);
    std::vector<SweptProxy> result;
    for (std::size_t i = 0; i < objects; ++i)
    {
        const Envelope envelope = random_envelope(random, half_room(objects));
        result.push_back({static_cast<ProxyId>(i), FloatBox::around(envelope.swept(ticks))});
    }
    return result;
}
} // namespace ode_predictive_space::micro

#endif
