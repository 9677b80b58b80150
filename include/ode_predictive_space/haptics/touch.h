// Touches and materials for force laws.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_H

#include "ode_predictive_space/haptics/device.h"

#include <cstddef>
#include <ode/common.h>
#include <optional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Material of a surface, in the scene. All finite and >= 0.
struct Material
{
    double stiffness = 500;     ///< N/m; along the normal, and of friction's hold
    double damping = 0;         ///< N s/m; along the normal
    double friction = 0;        ///< Coulomb's coefficient while the probe slides
    double static_friction = 0; ///< before it slides; at least `friction` is used
};

/// A touch's part of the displacement from the tool to its proxy: share times normal, plus lag. The sum over all
/// touches is that displacement.
struct Carry
{
    double share = 0; ///< m, >= 0
    Vector3 lag =
        Vector3::Zero(); ///< m; remaining displacement of a proxy that has not reached the place that the planes allow

    /// Whether it is not zero.
    bool carries() const { return share > 0 || !lag.isZero(0); }
};

/// A touched plane of an object, or a near one, in the scene's frame. An object may have several, such as the floor and
/// the walls of a channel.
struct Touch
{
    Vector3 point = Vector3::Zero();            ///< m
    Vector3 normal = Vector3::UnitZ();          ///< of length 1, from the surface towards the probe
    double depth = 0;                           ///< m; of the probe behind the surface
    Vector3 surface_velocity = Vector3::Zero(); ///< m/s; of the touched object at the point
    /// 1/kg; speed of the surface along the normal per impulse, for the free body; 0 if no push moves it. Touches of
    /// bodies yield to each other by it.
    double mobility = 0;
    /// s; time until the body responds to a push, if it is more than a tick: the step of the scene.
    double response_time = 0;
    Vector3 arm = Vector3::Zero(); ///< m; from the body's centre of mass to the point
    std::uintptr_t object = 0;     ///< identity of the object from tick to tick: object_of()
    bool from_entry_side = false;  ///< the normal is that of the side of entry, at any depth
    bool is_solved = false;        ///< whether `carry` is valid, as it is for laws
    Carry carry;                   ///< solution of the constraint
    std::uint32_t id = 0;          ///< identity of the touch from tick to tick; 0: not yet known
    /// The id of the touch that carried the tool in the tick before: its own, or that of the surface from which it
    /// continues; 0: none.
    std::uint32_t takes_over = 0;
    double part = 1; ///< 0 to 1; rendered part of the depth, while an object that appeared around the probe rises
    /// Default: the force law's. A renderer fills in a material that the device can render, with a gradual transition.
    std::optional<Material> material;
};

/// The largest number of touches that are felt at once, and of geoms that are known near the probe. Beyond it, the farthest geoms and the
/// touches that hold off nothing or least give no force, and a notice says so.
constexpr std::size_t touch_capacity = 256;

/// Touch::object of a geom: its body, or itself without one.
std::uintptr_t object_of(dGeomID geom);

/// Views of several objects at once.
enum class TouchView
{
    each_object_alone, ///< each object's, as if there were no other
    all_together       ///< those that hold off the probe from all objects at once
};

/// The carry of a touch; without a solved constraint, its depth as if it were alone.
inline Carry carry_of(const Touch &touch)
{
    return touch.is_solved ? touch.carry : Carry{touch.depth, Vector3::Zero()};
}

/// Forces on the probe, N, one per touch in their order. The objects get the opposite.
using TouchForces = std::vector<Vector3>;

/// ForceShare::object of a force in free space: see ForceLaw::forces().
constexpr std::uintptr_t free_space = 0;

/// An object's part of the force on the hand.
struct ForceShare
{
    std::uintptr_t object = free_space; ///< Touch::object
    Vector3 point = Vector3::Zero();    ///< m, the scene's frame; last touched point
    Vector3 force = Vector3::Zero();    ///< N, the scene's frame; on the hand
    std::uint32_t touch = 0;            ///< Touch::id; in free space, the index of the entry
    Vector3 arm = Vector3::Zero();      ///< Touch::arm, at the present pose of the body
};

/// Heights of a heightfield, as for dGeomHeightfieldDataBuildDouble(). The y axis of its frame points up.
struct HeightfieldSamples
{
    double width = 0;            ///< m, > 0; along x
    double depth = 0;            ///< m, > 0; along z
    int width_samples = 0;       ///< >= 2
    int depth_samples = 0;       ///< >= 2
    double scale = 1;            ///< m; of a height of 1
    double offset = 0;           ///< m; of a height of 0
    std::vector<double> heights; ///< column x and row z at x + z * width_samples
};
} // namespace ode_predictive_space::haptics

#endif
