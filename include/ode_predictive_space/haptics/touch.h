// What the probe touches, as force laws see it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_H

#include "ode_predictive_space/haptics/device.h"

#include <cstddef>
#include <ode/common.h>
#include <optional>
#include <vector>

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

/// What a touch adds to the way from the tool to its proxy: share times its normal, and its lag. All touches make that way.
struct Carry
{
    double share = 0;              ///< m, >= 0
    Vector3 lag = Vector3::Zero(); ///< m; while the proxy has not come to where the planes let it go

    /// Is there anything to carry the tool by?
    bool carries() const { return share > 0 || !lag.isZero(0); }
};

/// A plane of an object that holds off the probe, or nearly, in the scene's frame. An object may have several at once: the
/// floor and the walls of a channel.
struct Touch
{
    Vector3 point = Vector3::Zero();            ///< m
    Vector3 normal = Vector3::UnitZ();          ///< of the touched surface, of length 1, towards the probe
    double depth = 0;                           ///< m, >= 0; how far the probe is beyond the surface
    Vector3 surface_velocity = Vector3::Zero(); ///< m/s; of the touched object at the point
    /// 1/kg; how fast the surface moves along the normal after a push of 1 N s, if nothing else holds its body: the touches of bodies that
    /// are pushed from several sides at once give way to each other by that. 0 for what no push moves.
    double mobility = 0;
    /// s; how long the body takes to answer a push, where that is more than a tick: it moves with the next step of the scene.
    double response_time = 0;
    Vector3 arm = Vector3::Zero(); ///< m; from the body's centre of mass to the point
    std::uintptr_t object = 0;     ///< which object: the same from tick to tick, different for different ones
    unsigned feature = 0; ///< which plane of the object: the same from tick to tick, different for those of one object
    bool from_entry_side = false; ///< the normal is that of the side by which the probe came, however deep it is by now
    bool is_solved = false;       ///< whether the next one is known: laws get it with each touch
    Carry carry;                  ///< the solved constraint
    std::uint32_t id = 0;         ///< which touch: the same from tick to tick; 0 before it is recognised
    /// The id of the one that carried the tool here in the tick before: its own, or that of the surface that it goes on
    /// from; 0: nothing did.
    std::uint32_t takes_over = 0;
    double part = 1; ///< 0 to 1; of its depth, that is felt: less while an object rises that appeared around the probe
    /// Nothing: the force law's own. A renderer fills in what the device can render, gradually from what it takes over from.
    std::optional<Material> material;
};

/// The largest number of touches that are felt at once, and of geoms that are known near the probe. Beyond it, the farthest geoms and the
/// touches that hold off nothing or least give no force, and a notice says so.
constexpr std::size_t touch_capacity = 256;

/// What Touch::object is for a geom: its body, or itself if it has none.
std::uintptr_t object_of(dGeomID geom);

/// What the touches are of several objects at once.
enum class TouchView
{
    each_object_alone, ///< each object's, as if there were no other
    all_together       ///< those that hold off the probe from all objects at once
};

/// What a touch carries the tool by. Of one whose constraint was not solved: its depth, as if it were alone.
inline Carry carry_of(const Touch &touch)
{
    return touch.is_solved ? touch.carry : Carry{touch.depth, Vector3::Zero()};
}

/// The forces on the probe, in N, one per touch and in their order: what each of the objects gets is minus that.
using TouchForces = std::vector<Vector3>;

/// ForceShare::object of a force in free space: see ForceLaw::forces().
constexpr std::uintptr_t free_space = 0;

/// The part of the force on the hand that one object made.
struct ForceShare
{
    std::uintptr_t object = free_space; ///< Touch::object
    Vector3 point = Vector3::Zero();    ///< m, the scene's frame; where it was touched last
    Vector3 force = Vector3::Zero();    ///< N, the scene's frame; on the hand
    unsigned feature = 0;               ///< Touch::feature; in free space, which of the entries, from 0 on
    Vector3 arm = Vector3::Zero();      ///< Touch::arm; from where the body is by now, the force acts there
};

/// The heights of a heightfield, as it was built of them by dGeomHeightfieldDataBuildDouble() or the like. Its frame's y
/// axis points up.
struct HeightfieldSamples
{
    double width = 0;            ///< m, > 0; along x
    double depth = 0;            ///< m, > 0; along z
    int width_samples = 0;       ///< >= 2
    int depth_samples = 0;       ///< >= 2
    double scale = 1;            ///< m; of a height of 1
    double offset = 0;           ///< m; of a height of 0
    std::vector<double> heights; ///< that of column x and row z is at x + z * width_samples
};
} // namespace ode_predictive_space::haptics

#endif
