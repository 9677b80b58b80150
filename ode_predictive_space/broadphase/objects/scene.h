// What the broad phase asks about the objects: they are known to it by number alone.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_SCENE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_SCENE_H

#include <cstddef>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/objects/place.h"
#include "ode_predictive_space/prediction/track.h"

namespace ode_predictive_space
{
/// The centre of an object as notices compute it, from the pose of a body and an offset.
struct Carried
{
    float centre[3]; ///< from the origin
    float radius;    ///< around any centre that is computed so, with an offset of no larger coordinates
    float offset;    ///< its largest coordinate
};

/// An object as it is now, for its next prediction. Lengths in the scene's unit.
struct Observation
{
    std::optional<Vector3> centre; ///< the point that the object turns around; finite. None when that is not known
    double radius = 0;             ///< of a sphere around the centre that holds the object; infinite when none is known
    std::optional<Vector3> velocity; ///< in the program's unit, if the object has a body that tells
    std::optional<Carried> carried;  ///< if notices compute its centre from a body and an offset
    bool is_costly = false;          ///< the contacts of its shape are costly to find: many points or triangles
};

struct ConvexShape;

/// The objects, by number. A caller asks about many objects at once; the scene knows how to prefetch them.
class Scene
{
public:
    virtual ~Scene() = default;

    /// Writes the bounding box of each of the objects into places[id]: by Place::measure(), or another one.
    virtual void measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin) = 0;

    /// Writes what a prediction needs, in the order of `ids`.
    virtual void observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &origin) = 0;

    /// Brings the shape of each of the objects up to date, and tells how far the object has moved since: the most
    /// that any point of its surface has; infinite when the shape is another one now. All in the order of `ids`.
    ///
    /// Here: unknown shapes, for scenes that are judged by boxes alone.
    virtual void follow(const ProxyId *ids, std::size_t count, ConvexShape *const *shapes, double *moves);

    /// Does the hull of an object's shape no longer serve, or is it there now where the shape has awaited it? The data of hulls change
    /// without notice.
    virtual bool hull_is_outdated(ProxyId id, const ConvexShape &shape);

    /// Are coordinates so precise that it makes a difference where they are counted from in single precision?
    virtual bool is_in_double_precision() const { return true; }

    /// The object's bounding box in double precision.
    virtual Box bounds(ProxyId id) = 0;

    /// The pose of the object, from which forecasts of its motion are made.
    virtual SampledPose pose(ProxyId id) = 0;

    /// Do the objects' bounding boxes overlap and, by the sphere test of proximity, their bounding spheres, too?
    virtual bool overlap(ProxyId first, ProxyId second) = 0;

    /// Is the pair not reported even when it touches? The reasons may change without notice.
    virtual bool is_excluded(ProxyId first, ProxyId second);

    /// Appends to `disabled` those of the objects that are in no reported pair as long as they are disabled, in the order of
    /// `ids`. Objects are enabled and disabled without notice.
    virtual void find_disabled(const ProxyId *ids, std::size_t count, std::vector<ProxyId> &disabled) = 0;
};
} // namespace ode_predictive_space

#endif
