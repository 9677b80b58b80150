// A geom that the probe is near to, as it was when the near callback came.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NEARBY_GEOM_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NEARBY_GEOM_H

#include "ode_predictive_space/haptics/contact/mesh_store.h"
#include "ode_predictive_space/haptics/contact/mobility.h"
#include "ode_predictive_space/haptics/contact/other_probes.h"
#include "ode_predictive_space/haptics/contact/pose_watch.h"
#include "ode_predictive_space/haptics/contact/solid.h"
#include "ode_predictive_space/haptics/touch.h"

#include <memory>
#include <optional>

namespace ode_predictive_space::haptics
{
/// Which geom it is: equal as long as it is the same thing, with the same body and the same surface. To compare only.
struct GeomIdentity
{
    dGeomID id = nullptr;
    std::uintptr_t object = 0;
    const MeshTree *mesh = nullptr; ///< 0 for a solid

    bool operator==(const GeomIdentity &other) const
    {
        return id == other.id && object == other.object && mesh == other.mesh;
    }
};

/// All that contact needs to know of a geom: a copy, since the program may destroy the geom at any time.
class NearbyGeom
{
public:
    NearbyGeom() = default;

    /// It moves as its body does. Nothing for a geom whose surface is known to ODE alone (convex, heightfield without samples,
    /// transform, classes of the program, mesh that is being read).
    ///
    /// @param touched triangles of the mesh that were touched last: see MeshStore.
    static std::optional<NearbyGeom> read(dGeomID geom, MeshStore &meshes, const TriangleList &touched);

    /// A geom whose surface ODE alone knows, as a half-space: behind the plane through the point of the surface that is nearest to the
    /// proxy.
    ///
    /// @param point m; on the surface. @param normal of length 1, towards the proxy; both in the scene's frame.
    static NearbyGeom behind_plane(dGeomID geom, const Vector3 &point, const Vector3 &normal);

    /// The tool of another probe.
    static NearbyGeom of(const ProbeTool &tool);

    dGeomID id() const { return id_; } ///< to compare, not to use
    std::uintptr_t object() const { return object_; }

    /// Whether it has a place. Its velocity may still be none: see velocity_at().
    bool is_finite() const { return pose_.rotation.allFinite() && pose_.position.allFinite(); }

    GeomIdentity identity() const { return {id_, object_, mesh_.get()}; }

    /// About the centre of its body, if it has one.
    void set_motion(const Motion &motion) { motion_ = motion; }

    /// The geom as it is some time later, with the velocity that it has.
    ///
    /// Real-time: the copy shares a mesh without owning it. It must not be used when this one is gone.
    ///
    /// @param dt s.
    NearbyGeom later(double dt) const;

    /// Its body has moved by this (m), has turned by this vector about its centre (rad), and has this much more velocity (m/s) and spin (rad/s).
    void shift(const Vector3 &moved, const Vector3 &turned, const Vector3 &velocity, const Vector3 &spin);

    void set_material(const std::optional<Material> &material) { material_ = material; }
    const std::optional<Material> &material() const { return material_; }

    /// s; when its body answers a push by the next step of the scene alone, how long that is. 0: within a tick.
    void set_step(double seconds) { step_ = seconds; }
    double step() const { return step_; }

    /// From the thread of the scene, after the program has made its contact joints: whether the body is in contact with something.
    void note_contacts();
    bool is_in_contact() const { return in_contact_; }

    /// The body got an impulse (N s) at the end of an arm (m) some time ago (s), and has moved by it since, as if nothing held it.
    void push(const Vector3 &impulse, const Vector3 &arm, double since);

    /// Whether a push moves it.
    bool is_movable() const { return !mobility_.is_zero(); }

    double inverse_mass() const { return mobility_.inverse_mass; } ///< 1/kg

    /// 1/kg; how fast a place of the surface moves along a direction of length 1 after a push of 1 N s, if nothing else holds the body.
    double mobility_at(const Vector3 &point, const Vector3 &direction) const
    {
        return mobility_.along(arm_of(point), direction);
    }

    /// m; from the centre of its body.
    Vector3 arm_of(const Vector3 &point) const { return point - motion_.centre; }

    /// m/s, of the surface.
    Vector3 velocity_at(const Vector3 &point) const { return motion_.velocity_at(point); }

    /// m/s; of the plane that stands for a surface that ODE alone knows, along its normal; 0 for other geoms.
    double speed_of_plane() const;

    Vector3 to_local(const Vector3 &point) const { return pose_.rotation.transpose() * (point - pose_.position); }
    Vector3 to_scene(const Vector3 &point) const { return pose_.rotation * point + pose_.position; }

    /// Append what of the surface is within a radius of a point. The scene's frame. See MeshTree::collect().
    ///
    /// @return the distance to the surface, or the radius if that is less.
    double collect(const Vector3 &point, double radius, SurfaceFeatures &features,
                   MeshTree::Budget *budget = nullptr) const;

    /// The distance from a point to the surface, below 0 inside of a solid; `most` if that is less.
    double distance(const Vector3 &point, double most) const;

    /// Whether a point is inside of a mesh whose triangles face outwards, holes or not, or below a heightfield. Never of a
    /// solid: see distance().
    bool contains(const Vector3 &point) const;

    /// The same face, edge or corner that a feature is of, or its neighbour in the same triangle, as seen from another
    /// point.
    SurfaceFeature nearest_of(const SurfaceFeature &feature, const Vector3 &point) const;

    /// Whether there is an inside that a point is in, and out of which it may go any way.
    bool is_solid() const { return solid_.is_known(); }

private:
    /// Without its surface.
    explicit NearbyGeom(dGeomID geom);

    void move_to_scene(SurfaceFeature &feature) const;

    dGeomID id_ = nullptr;
    std::uintptr_t object_ = 0;
    Pose pose_; ///< a ball's frame does not turn: a light one that spins would carry the proxy around itself
    Motion motion_;
    Mobility mobility_;
    double step_ = 0;
    bool in_contact_ = false;
    std::optional<Material> material_;
    Solid solid_;
    std::shared_ptr<const MeshTree> mesh_;
    bool is_field_ = false;           ///< the mesh is that of a heightfield
    bool by_plane_ = false;           ///< the solid is a half-space that stands for the geom
    Vector3 point_ = Vector3::Zero(); ///< m; of the surface, in that plane
};
} // namespace ode_predictive_space::haptics

#endif
