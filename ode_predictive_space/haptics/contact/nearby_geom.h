// A copy of all the data of a geom near the probe that contact needs, because the program may destroy the geom at any time.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NEARBY_GEOM_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NEARBY_GEOM_H

#include "ode_predictive_space/haptics/contact/mesh_store.h"
#include "ode_predictive_space/haptics/contact/mobility.h"
#include "ode_predictive_space/haptics/contact/other_probes.h"
#include "ode_predictive_space/haptics/contact/pose_watch.h"
#include "ode_predictive_space/haptics/contact/solid.h"
#include "ode_predictive_space/haptics/touch.h"

#include <memory>
#include <ode/contact.h>
#include <optional>

namespace ode_predictive_space::haptics
{
/// Identity of a geom with its body and its surface, for comparisons only.
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

class NearbyGeom
{
public:
    NearbyGeom() = default;

    /// Reads a geom, with the motion of its body. Returns nothing for a surface that ODE alone knows (convex, heightfield
    /// without samples, transform, classes of the program, mesh that is being read).
    /// @param touched touched triangles of the mesh: see MeshStore.
    static std::optional<NearbyGeom> read(dGeomID geom, MeshStore &meshes, const TriangleList &touched);

    /// A geom whose surface ODE alone knows, as the half-space behind the plane through its point nearest to the proxy.
    /// @param point m; on the surface. @param normal of length 1, towards the proxy; both in the scene's frame.
    static NearbyGeom behind_plane(dGeomID geom, const Vector3 &point, const Vector3 &normal);

    /// The other geom of a contact of dCollide() with a geom of the program at the tool, as such a half-space.
    /// @param tool m; the contact is at a lever from it.
    static NearbyGeom at_contact(dGeomID geom, const dContactGeom &contact, const Vector3 &tool);

    static NearbyGeom of(const ProbeTool &tool);

    dGeomID id() const { return id_; } ///< for comparisons only
    std::uintptr_t object() const { return object_; }

    bool is_finite() const { return pose_.rotation.allFinite() && pose_.position.allFinite(); }

    GeomIdentity identity() const { return {id_, object_, mesh_.get()}; }

    void set_motion(const Motion &motion) { motion_ = motion; }

    /// The geom after a time at its present velocity. The copy shares the mesh without owning it: it must not outlive *this.
    NearbyGeom later(double dt) const;

    /// Adds displacement (m), rotation about the body's centre (rad), velocity (m/s) and spin (rad/s).
    void shift(const Vector3 &moved, const Vector3 &turned, const Vector3 &velocity, const Vector3 &spin);

    void set_material(const std::optional<Material> &material) { material_ = material; }
    const std::optional<Material> &material() const { return material_; }

    /// s; the step of the scene if the body responds to a push only in the next step; 0: within a tick.
    void set_step(double seconds) { step_ = seconds; }
    double step() const { return step_; }

    /// Reads whether the body is in contact. For the thread of the scene, after the program has made its contact joints.
    void note_contacts();
    bool is_in_contact() const { return in_contact_; }

    /// Applies an impulse (N s) at the end of an arm (m), given some time ago (s), to the free body.
    void push(const Vector3 &impulse, const Vector3 &arm, double since);

    bool is_movable() const { return !mobility_.is_zero(); }

    /// 1/kg; speed of a place of the surface along a direction of length 1 per impulse, for the free body.
    double mobility_at(const Vector3 &point, const Vector3 &direction) const
    {
        return mobility_.along(arm_of(point), direction);
    }

    Vector3 arm_of(const Vector3 &point) const { return point - motion_.centre; }

    Vector3 velocity_at(const Vector3 &point) const { return motion_.velocity_at(point); }

    /// m/s; speed along the normal of the plane that stands for the surface; 0 for other geoms.
    double speed_of_plane() const;

    Vector3 to_local(const Vector3 &point) const { return pose_.rotation.transpose() * (point - pose_.position); }
    Vector3 to_scene(const Vector3 &point) const { return pose_.rotation * point + pose_.position; }

    /// Appends the features within a radius of a point, in the scene's frame; see MeshTree::collect().
    double collect(const Vector3 &point, double radius, SurfaceFeatures &features,
                   MeshTree::Budget *budget = nullptr) const;

    /// The distance from a point to the surface, at most `most`, negative inside of a solid.
    double distance(const Vector3 &point, double most) const;

    /// Whether a point is inside of a mesh whose triangles face outwards, or below a heightfield. For solids see distance().
    bool contains(const Vector3 &point) const;

    /// The nearest place of the feature's triangle, or of the solid, to another point.
    SurfaceFeature nearest_of(const SurfaceFeature &feature, const Vector3 &point) const;

    Touch touch_of(const SurfaceFeature &feature) const;

    /// The touch of at_contact() with the program's geom at another tool, which does not turn; outside, its depth is below 0.
    Touch touch_at(const Vector3 &tool) const { return touch_of(nearest_of(SurfaceFeature(), tool + lever_)); }

    /// Whether a point inside may leave in any direction.
    bool is_solid() const { return solid_.is_known(); }

private:
    explicit NearbyGeom(dGeomID geom);

    void move_to_scene(SurfaceFeature &feature) const;

    dGeomID id_ = nullptr;
    std::uintptr_t object_ = 0;
    Pose pose_; ///< a ball's frame does not turn: a spinning ball would carry the proxy around itself
    Motion motion_;
    Mobility mobility_;
    double step_ = 0;
    bool in_contact_ = false;
    std::optional<Material> material_;
    Solid solid_;
    std::shared_ptr<const MeshTree> mesh_;
    bool is_field_ = false;           ///< the mesh is that of a heightfield
    bool by_plane_ = false;           ///< the solid is a plane from dCollide()
    Vector3 point_ = Vector3::Zero(); ///< m; the point of that plane on the surface
    Vector3 lever_ = Vector3::Zero(); ///< m; from the tool to the point of the program's geom behind the surface
};
} // namespace ode_predictive_space::haptics

#endif
