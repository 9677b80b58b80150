#include "ode_predictive_space/haptics/felt_materials.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double similar = 0.5; // cosine
}

void FeltMaterials::follow(const std::vector<Touch> &touches, const std::vector<char> &pressed, const Material &own,
                           double dt)
{
    now_.swap(before_);
    now_.clear();
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const Touch &touch = touches[i];
        Felt felt{touch.object, touch.feature, pressed[i] != 0, touch.normal, touch.material.value_or(own)};
        const Felt *last = felt.pressed ? predecessor(touch) : nullptr;
        if (last != nullptr)
            felt.material = blended(last->material, felt.material, dt);
        now_.push_back(felt);
    }
}

/// Itself, or else the one whose normal is most like it.
const FeltMaterials::Felt *FeltMaterials::predecessor(const Touch &touch) const
{
    const Felt *best = nullptr;
    double agreement = similar;
    for (const Felt &felt : before_)
    {
        if (!felt.pressed)
            continue;
        if (felt.object == touch.object && felt.feature == touch.feature)
            return &felt;
        const double cosine = felt.normal.dot(touch.normal);
        if (cosine > agreement && (successor_ == Successor::any_object || felt.object == touch.object))
        {
            best = &felt;
            agreement = cosine;
        }
    }
    return best;
}

void FeltMaterials::reset()
{
    now_.clear();
    before_.clear();
}
} // namespace ode_predictive_space::haptics
