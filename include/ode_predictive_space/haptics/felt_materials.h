// The materials of what is touched, from tick to tick.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_FELT_MATERIALS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_FELT_MATERIALS_H

#include "ode_predictive_space/haptics/touch.h"

namespace ode_predictive_space::haptics
{
/// The material by which a law renders each touch: its own, reached gradually when it takes over from another touch or has
/// changed (see blended()). Does not allocate when it has seen as many touches before.
class FeltMaterials
{
public:
    /// Whose place a new touch can take: that of a touch of the same object, or of any. The normals differ by less than 60 degrees then.
    enum class Successor
    {
        same_object,
        any_object
    };

    /// @param successor from which touch a new one takes over its material.
    explicit FeltMaterials(Successor successor) : successor_(successor) {}

    /// One tick. @param own what touches without a material are of. @param pressed whether a touch carries the tool; in their order.
    void follow(const std::vector<Touch> &touches, const std::vector<char> &pressed, const Material &own, double dt);

    /// Of each touch, in their order.
    const Material &operator[](std::size_t touch) const { return now_[touch].material; }

    /// Forget all touches: those of the next tick have their own materials at once.
    void reset();

private:
    struct Felt
    {
        std::uintptr_t object;
        unsigned feature;
        bool pressed;
        Vector3 normal;
        Material material;
    };

    const Felt *predecessor(const Touch &touch) const;

    Successor successor_;
    std::vector<Felt> now_;
    std::vector<Felt> before_;
};
} // namespace ode_predictive_space::haptics

#endif
