// The broad phase's interface to the objects, which it knows only by number.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_SCENE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_SCENE_H

#include <cstddef>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/objects/place.h"
#include "ode_predictive_space/prediction/track.h"

namespace ode_predictive_space
{
/// The centre of an object as notices compute it, from the pose of a body and an offset.
struct Carried
{
    float centre[3]; ///< relative to the origin
    float radius;    ///< holds the object around a centre that is computed from an offset of no larger coordinates
    float offset;    ///< largest coordinate of the offset
};

/// The state of an object for its next prediction. Lengths are in the scene's unit.
struct Observation
{
    std::optional<Vector3> centre;   ///< the point about which the object turns; finite, none if unknown
    double radius = 0;               ///< a sphere of it around the centre holds the object; infinite if unknown
    std::optional<Vector3> velocity; ///< in the program's unit; none without a dynamic body
    std::optional<Carried> carried;  ///< if notices compute the centre from a body and an offset
    bool is_costly = false;          ///< contacts of the shape are costly to find: it has many points or triangles
};

struct ConvexShape;

/// The objects by number. Most calls ask about many at once, so that the scene can prefetch.
class Scene
{
public:
    virtual ~Scene() = default;

    /// Writes the bounding box of each object into places[id], by Place::measure() or Place::set_tight().
    virtual void measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin) = 0;

    virtual void observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &origin) = 0;

    /// Brings shapes up to date, in the order of `ids`.
    /// @param moves receives upper bounds of the surfaces' displacements since the last call; infinite for a replaced shape.
    virtual void follow(const ProxyId *ids, std::size_t count, ConvexShape *const *shapes, double *moves) = 0;

    /// Whether the shape's hull is out of date, or the awaited hull is no longer being made. Data change without notice.
    virtual bool hull_is_outdated(ProxyId id, const ConvexShape &shape) = 0;

    /// Whether coordinates are finer than single precision, so that moving the origin helps.
    virtual bool is_in_double_precision() const = 0;

    virtual Box bounds(ProxyId id) = 0;

    virtual SampledPose pose(ProxyId id) = 0;

    /// Whether the bounding boxes overlap and, by the sphere test, the bounding spheres, too.
    virtual bool overlap(ProxyId first, ProxyId second) = 0;

    /// Whether a filter keeps the pair from being reported. It may change without notice.
    virtual bool is_excluded(ProxyId first, ProxyId second) = 0;

    /// Adds those of the objects that are disabled now. They change without notice.
    virtual void find_disabled(const std::vector<ProxyId> &ids, IdSet &disabled) = 0;
};
} // namespace ode_predictive_space

#endif
