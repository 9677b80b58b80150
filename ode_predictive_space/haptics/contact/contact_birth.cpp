#include "ode_predictive_space/haptics/contact/contact_birth.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rise_time = 0.5;     // s
constexpr double unnoticed = 1e-4;    // m
constexpr double of_the_motion = 3.0; // times
} // namespace

bool ContactBirth::began_at_surface(const Touch &touch, double handed_over) const
{
    const double moved = gap_ * (touch.surface_velocity - tool_.linear_velocity).norm();
    return touch.depth <= unnoticed + of_the_motion * moved + handed_over;
}

double ContactBirth::risen(double part, double dt)
{
    return std::min(1.0, part + dt / rise_time);
}
} // namespace ode_predictive_space::haptics
