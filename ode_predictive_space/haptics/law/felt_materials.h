// The materials of what is touched, from tick to tick.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_FELT_MATERIALS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_FELT_MATERIALS_H

#include "ode_predictive_space/haptics/touch.h"

namespace ode_predictive_space::haptics
{
/// The material by which a law renders each touch: its own, reached gradually when it takes over from another touch (Touch::takes_over) or
/// has changed (see blended()). Does not allocate when it has seen as many touches before.
class FeltMaterials
{
public:
    /// One tick. @param own what touches without a material are of.
    void follow(const std::vector<Touch> &touches, const Material &own, double dt);

    /// Of each touch, in their order.
    const Material &operator[](std::size_t touch) const { return now_[touch].material; }

    /// Forget all touches: those of the next tick have their own materials at once.
    void reset();

private:
    struct Felt
    {
        std::uint32_t id; ///< Touch::id
        Material material;
    };

    std::vector<Felt> now_;
    std::vector<Felt> before_;
};
} // namespace ode_predictive_space::haptics

#endif
