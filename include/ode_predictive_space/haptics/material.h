// What a surface feels like.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MATERIAL_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MATERIAL_H

namespace ode_predictive_space::haptics
{
/// What the hand feels of a surface, in the scene's frame. All finite and >= 0.
struct Material
{
    double stiffness = 500;     ///< N/m; along the normal, and of friction's hold
    double damping = 0;         ///< N s/m; along the normal
    double friction = 0;        ///< Coulomb's coefficient while the probe slides
    double static_friction = 0; ///< the same until it begins to slide; less than friction counts as friction
};

/// The same, by its first name.
using SurfaceProperties = Material;

/// @throws std::invalid_argument that names the property which is negative or not finite.
void check(const Material &material);

/// The same, for where nothing may be thrown.
bool is_valid(const Material &material);

/// From one material towards another: where the probe goes from one surface to the next, or a material is changed, the force must not
/// jump. Each property goes by at most its larger value in 20 ms.
///
/// @param dt s.
Material blended(const Material &from, const Material &to, double dt);
} // namespace ode_predictive_space::haptics

#endif
