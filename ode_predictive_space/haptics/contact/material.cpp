#include "ode_predictive_space/haptics/touch.h"

#include <algorithm>

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/device/check_argument.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double blend_time = 0.02; // s

double blended(double from, double to, double dt)
{
    const double most = std::max(from, to) * dt / blend_time;
    return from + std::clamp(to - from, -most, most);
}
} // namespace

void check(const Material &material)
{
    check_not_negative(material.stiffness, "stiffness of a material");
    check_not_negative(material.damping, "damping of a material");
    check_not_negative(material.friction, "friction of a material");
    check_not_negative(material.static_friction, "static friction of a material");
}

bool is_valid(const Material &material)
{
    return is_amount(material.stiffness) && is_amount(material.damping) && is_amount(material.friction) &&
           is_amount(material.static_friction);
}

Material blended(const Material &from, const Material &to, double dt)
{
    return {blended(from.stiffness, to.stiffness, dt), blended(from.damping, to.damping, dt),
            blended(from.friction, to.friction, dt), blended(from.static_friction, to.static_friction, dt)};
}
} // namespace ode_predictive_space::haptics
