// A simulated hand that makes reaches of minimum jerk, with tremor, and the device that it holds.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_HAND_PATH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_HAND_PATH_H

#include "ode_predictive_space/haptics/device.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Motion of the hand in its own size; `scale` maps it into the device's workspace or a scene.
struct HandPathSettings
{
    Vector3 centre = Vector3::Zero(); ///< middle of the workspace, metres
    double scale = 1;                 ///< metres per metre of the hand
    double half_workspace = 0.15;     ///< half the side of the cube in which the hand's targets lie, metres of the hand
    double shortest_reach = 0.1;      ///< metres of the hand
    double longest_reach = 0.3;       ///< metres of the hand
    double shortest_time = 0.3;       ///< seconds, for the shortest reach
    double longest_time = 0.8;        ///< seconds, for the longest reach
    double longest_pause = 0.2;       ///< seconds; maximum pause between two reaches
    double tremor = 0.0002;           ///< largest tremor along each axis, metres of the hand
};

/// Position of the hand at any time.
///
/// A reach from A to B in time T follows A + (B - A) (10 u^3 - 15 u^4 + 6 u^5), u = t / T: the minimum-jerk motion of
/// people (Flash and Hogan, 1985), from rest to rest. Tremor is the sum of two sines of 8 to 12 Hz along each axis.
class HandPath
{
public:
    /// Equal settings and seeds give equal paths.
    HandPath(const HandPathSettings &settings, std::uint64_t seed);

    /// The position, m, at `time` (s) after the start. Not const, because it generates reaches up to that time.
    Vector3 position(double time);

    /// The derivative of position(), m/s.
    Vector3 velocity(double time);

    /// Generates the reaches of the first `seconds` now, so that calls up to that time do not allocate.
    void draw_ahead(double seconds = 600);

    /// The bound, m, of the distance of position() from the centre along each axis.
    double half_extent() const;

private:
    struct Reach
    {
        double start; ///< seconds
        double duration;
        double pause; ///< seconds of rest after it
        Vector3 from; ///< metres of the hand, from the centre
        Vector3 to;
    };

    struct Sine
    {
        double rate;  ///< radians/s
        double phase; ///< radians
    };

    const Reach &reach_at(double time);
    void add_reach();
    template <class Value> Vector3 tremor(Value value_of) const;

    HandPathSettings settings_;
    std::uint64_t random_; ///< state of the stream of random numbers
    std::array<std::array<Sine, 2>, 3> tremor_;
    std::vector<Reach> reaches_; ///< in the order of time, without gaps
};

/// A device whose handle follows a HandPath. Forces have no effect: see VirtualDevice for a hand that yields.
class HandPathDevice : public SoftwareDevice
{
public:
    /// The arguments are those of HandPath.
    explicit HandPathDevice(const HandPathSettings &settings = {}, std::uint64_t seed = 1);

protected:
    void start() override;
    DeviceState move_to(double seconds) override;

private:
    HandPath path_;
};
} // namespace ode_predictive_space::haptics

#endif
