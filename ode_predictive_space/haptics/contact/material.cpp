#include "ode_predictive_space/haptics/touch.h"

#include <algorithm>
#include <iterator>

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/device/check_argument.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double blend_time = 0.02; // s

struct Property
{
    double Material::*value;
    const char *name;
};

constexpr Property properties[] = {{&Material::stiffness, "stiffness of a material"},
                                   {&Material::damping, "damping of a material"},
                                   {&Material::friction, "friction of a material"},
                                   {&Material::static_friction, "static friction of a material"}};
} // namespace

void check(const Material &material)
{
    for (const Property &property : properties)
        check_not_negative(material.*property.value, property.name);
}

bool is_valid(const Material &material)
{
    return std::all_of(std::begin(properties), std::end(properties),
                       [&](const Property &property) { return is_amount(material.*property.value); });
}

Material blended(const Material &from, const Material &to, double dt)
{
    Material result = from;
    for (const Property &property : properties)
    {
        const double start = from.*property.value, end = to.*property.value;
        const double most = std::max(start, end) * dt / blend_time;
        result.*property.value += std::clamp(end - start, -most, most);
    }
    return result;
}
} // namespace ode_predictive_space::haptics
