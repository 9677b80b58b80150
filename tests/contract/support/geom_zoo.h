// A geom of every class, with awkward bounds of all kinds: off-centre, infinite, without a position.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_GEOM_ZOO_H
#define ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_GEOM_ZOO_H

#include <memory>

#include <ode/ode.h>

namespace ode_predictive_space
{
enum class GeomKind
{
    sphere,
    box,
    capsule,
    cylinder,
    ray,
    convex,             ///< a cube whose centre is away from its position
    trimesh,            ///< a tetrahedron, away from its position
    heightfield,        ///< finite and placeable, with its position at its centre
    transform,          ///< a dGeomTransform around a sphere that is away from its position
    user,               ///< a user class with bounds away from its position and an AABBTest
    plane,              ///< with its normal along an axis: a half space
    oblique_plane,      ///< infinite
    endless_heightfield ///< wrapped and not placeable: infinite in x and z
};

constexpr int geom_kind_count = 13;

const char *geom_kind_name(GeomKind kind);

/// Kinds with a position, which can be moved and carried by a body. All others are unbounded on some side.
bool is_placeable(GeomKind kind);

/// Makes a geom of about this size (convexes, meshes and heightfields have the sizes 0.3, 1 and 3 only).
dGeomID create_geom(GeomKind kind, dReal size, dSpaceID space);

/// Resizes a geom that create_geom() made, and sets its position again as a notice to the space: ODE sends none when a convex,
/// a mesh, a heightfield or a transform is changed.
void resize_geom(dGeomID geom, GeomKind kind, dReal size);
dTriMeshDataID mesh_data(dReal size);

/// Data of one convex or mesh, in any size, which can be changed in place. They must outlive the geom.
class OwnShapeData
{
public:
    virtual ~OwnShapeData() = default;
    virtual void give_to(dGeomID geom) const = 0;
    /// Changes the points in place. ODE sends no notice that the geom has another box.
    virtual void resize(dReal size) = 0;
};

/// @return null for kinds other than convexes and meshes.
std::unique_ptr<OwnShapeData> make_own_data(GeomKind kind, dReal size);

/// During its lifetime, one call of the aabb function of the user class throws, after `spared` others.
class ThrowingBounds
{
public:
    struct Thrown
    {};

    explicit ThrowingBounds(int spared);
    ~ThrowingBounds();
    ThrowingBounds(const ThrowingBounds &) = delete;
    ThrowingBounds &operator=(const ThrowingBounds &) = delete;
};
} // namespace ode_predictive_space

#endif
