#include "ode_predictive_space/haptics/law/felt_materials.h"
#include "ode_predictive_space/haptics/contact/material.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
void FeltMaterials::follow(const std::vector<Touch> &touches, const Material &own, double dt)
{
    now_.swap(before_);
    now_.clear();
    for (const Touch &touch : touches)
    {
        Felt felt{touch.id, touch.material.value_or(own)};
        const auto last = std::find_if(before_.begin(), before_.end(), [&](const Felt &other) {
            return touch.takes_over != 0 && other.id == touch.takes_over;
        });
        if (last != before_.end() && carry_of(touch).carries())
            felt.material = blended(last->material, felt.material, dt);
        now_.push_back(felt);
    }
}

void FeltMaterials::reset()
{
    now_.clear();
    before_.clear();
}
} // namespace ode_predictive_space::haptics
