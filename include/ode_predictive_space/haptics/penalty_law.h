// The law of the paper: a spring along the normal of the surface.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PENALTY_LAW_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PENALTY_LAW_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// F = k d n for each touch: stiffness times depth, along the normal; exactly that when damping and friction are 0. All three
/// are the touch's material's. d is the depth, or the plane's part of the shortest way out of an object that has several.
///
/// Damping adds b times the speed at which tool and surface approach each other (Kelvin and Voigt). Where that would pull, on
/// leaving a surface quickly, there is no force.
///
/// Friction is a spring of the same stiffness in the tangent plane, from the surface to the tool. It slips when it would pull
/// by more than static friction times the normal force, and then pulls by friction times it until that holds it again (Hayward
/// and Armstrong, "A new computational model of friction applied to haptic rendering", 2000). It works on displacements, not
/// on the sign of a measured velocity, hence it neither chatters nor creeps. The tool is a point to friction.
///
/// Objects know nothing of each other: in a notch between two of them, and at the seam of two tiles, each pushes as if it were alone. The
/// proxy law is right in both.
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
    /// Where friction's spring hangs: how far the tool has moved over the surface of an object since it took hold.
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
