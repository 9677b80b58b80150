// A law as the renderer uses it: touches have identities, and their constraint is solved.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_LAW_RENDERED_LAW_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_LAW_RENDERED_LAW_H

#include "ode_predictive_space/haptics/contact/contact_manifold.h"
#include "ode_predictive_space/haptics/force_law.h"

#include <utility>

namespace ode_predictive_space::haptics
{
template <class Law> class Rendered final : public ForceLaw
{
public:
    explicit Rendered(const Material &material = {}) : law_(material) {}

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override
    {
        touches_ = touches;
        manifold_.follow(tool, law_.view(), dt, {}, touches_);
        law_.forces(tool, touches_, dt, forces);
    }

    TouchView view() const override { return law_.view(); }
    Material material() const override { return law_.material(); }

    void reset() override
    {
        manifold_.reset();
        law_.reset();
    }

    const Vector3 &proxy() const { return law_.proxy(); }

private:
    Law law_;
    ContactManifold manifold_;
    std::vector<Touch> touches_;
};
} // namespace ode_predictive_space::haptics

#endif
