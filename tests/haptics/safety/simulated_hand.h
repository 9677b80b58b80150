// A hand that presses on a wall: the smallest system in which a haptic device shakes.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SAFETY_SIMULATED_HAND_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SAFETY_SIMULATED_HAND_H

#include "ode_predictive_space/haptics/device.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace ode_predictive_space::haptics
{
/// Device and hand as a mass with a damper on the x axis. The motion is exact, as the force is constant between writes.
struct SimulatedHand
{
    double mass = 0.1;    // kg
    double damping = 0.5; // N s/m
    double push = 0;      // N; from the person
    double position = 0;  // m
    double velocity = 0;  // m/s

    void move(double force, double dt)
    {
        const double last = (force + push) / damping; // m/s; final velocity
        const double decay = std::exp(-damping * dt / mass);
        position += last * dt + (velocity - last) * mass / damping * (1 - decay);
        velocity = last + (velocity - last) * decay;
    }

    DeviceState state() const
    {
        DeviceState result;
        result.position.x() = position;
        result.linear_velocity.x() = velocity;
        return result;
    }
};

/// A wall in x < 0 that answers with a delay in ticks.
class SimulatedWall
{
public:
    SimulatedWall(double stiffness, int delay) : stiffness_(stiffness), forces_(static_cast<std::size_t>(delay), 0) {}

    double force_at(double position)
    {
        forces_.push_back(stiffness_ * std::max(0.0, -position));
        const double force = forces_.front();
        forces_.pop_front();
        return force;
    }

private:
    double stiffness_;
    std::deque<double> forces_;
};

class Swing
{
public:
    void add(double position)
    {
        least_ = std::min(least_, position);
        most_ = std::max(most_, position);
    }
    double width() const { return most_ - least_; }

private:
    double least_ = 1e300, most_ = -1e300;
};
} // namespace ode_predictive_space::haptics

#endif
