// The law of the paper: a spring along the normal of the surface.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PENALTY_LAW_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PENALTY_LAW_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// F = k d n for each touch (Vogiannou et al.): stiffness times depth along the normal, exactly so without damping and
/// friction. The touch's material has all three. With several planes of an object, d is the plane's part of the
/// shortest displacement out of it.
///
/// Damping adds b times the speed of approach of tool and surface (Kelvin-Voigt). A negative sum becomes zero, so that
/// a surface never pulls.
///
/// Friction is a spring of the same stiffness in the tangent plane. It slips above static friction times the normal
/// force, and then pulls with friction times the normal force until it holds again (Hayward and Armstrong, "A new
/// computational model of friction applied to haptic rendering", 2000). It uses displacements instead of the sign of a
/// measured velocity, so it neither chatters nor creeps. Friction treats the tool as a point.
///
/// Objects are independent: in a notch between two of them, and at the seam of two tiles, each pushes as if it were
/// alone. The proxy law is correct in both.
class PenaltyLaw final : public ForceLaw
{
public:
    /// @throws std::invalid_argument for a property that is negative or not finite.
    explicit PenaltyLaw(const Material &material = {});

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override;
    void reset() override;
    Material material() const override { return material_; }
    const char *name() const override { return "penalty"; }

private:
    /// Friction's spring: the displacement of the tool over a surface since it held.
    struct Hold
    {
        std::uint32_t touch; // Touch::id
        Vector3 stretch;     // m, in the tangent plane
        bool slides;
    };

    Vector3 friction_force(const Touch &touch, const Material &material, double normal_force, const Vector3 &moved,
                           double dt);

    Material material_;
    std::vector<Hold> holds_;                 // of this tick
    std::vector<Hold> last_holds_;            // of the tick before
    Vector3 last_position_ = Vector3::Zero(); // of the tool; means nothing while last_holds_ is empty
};
} // namespace ode_predictive_space::haptics

#endif
