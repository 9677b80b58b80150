#include "tests/contract/support/geom_zoo.h"

#include <array>
#include <cmath>

// dGeomTransform is deprecated, but programs still use it.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

namespace ode_predictive_space
{
namespace
{
constexpr std::array<dReal, 3> mesh_sizes = {0.3, 1, 3};

std::size_t nearest_mesh(dReal size)
{
    return size < 0.6 ? 0 : size < 1.8 ? 1 : 2;
}

struct ConvexData
{
    std::array<dReal, 24> planes;
    std::array<dReal, 24> points;

    explicit ConvexData(dReal size) { set_size(size); }

    void set_size(dReal size)
    {
        planes = {1, 0, 0, size, 0, 1, 0, size, 0, 0, 1, size, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0};
        for (unsigned corner = 0; corner < 8; ++corner)
        {
            for (unsigned axis = 0; axis < 3; ++axis)
                points[corner * 3 + axis] = (corner >> axis & 1) ? size : 0;
        }
    }

    static const unsigned *polygons()
    {
        static const unsigned indices[] = {4, 1, 3, 7, 5, 4, 2, 6, 7, 3, 4, 4, 5, 7, 6,
                                           4, 0, 4, 6, 2, 4, 0, 1, 5, 4, 4, 0, 2, 3, 1};
        return indices;
    }

    void give_to(dGeomID geom) const { dGeomSetConvex(geom, planes.data(), 6, points.data(), 8, polygons()); }
};

struct MeshData
{
    std::array<float, 12> vertices;
    std::array<dTriIndex, 12> indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    dTriMeshDataID id = dGeomTriMeshDataCreate();

    explicit MeshData(dReal size) { set_size(size); }
    ~MeshData() { dGeomTriMeshDataDestroy(id); }
    MeshData(const MeshData &) = delete;
    MeshData &operator=(const MeshData &) = delete;

    void set_size(dReal size)
    {
        const float h = static_cast<float>(size) / 2;
        vertices = {h, h, h, 3 * h, h, h, h, 3 * h, h, h, h, 3 * h};
        // dGeomTriMeshDataUpdate() would leave the box of the data as it was.
        dGeomTriMeshDataBuildSingle(id, vertices.data(), 3 * sizeof(float), 4, indices.data(), 12,
                                    3 * sizeof(dTriIndex));
    }
};

struct HeightData
{
    dHeightfieldDataID id = dGeomHeightfieldDataCreate();

    HeightData(dReal size, bool endless)
    {
        const std::array<double, 9> heights = {0, 0.1, 0, 0.2, 0.3, 0.1, 0, 0.1, 0};
        dGeomHeightfieldDataBuildDouble(id, heights.data(), 1, 2 * size, 2 * size, 3, 3, 1, 0, size / 4, endless);
    }
    ~HeightData() { dGeomHeightfieldDataDestroy(id); }
    HeightData(const HeightData &) = delete;
    HeightData &operator=(const HeightData &) = delete;
};

const ConvexData &convex_data(dReal size)
{
    static const std::array<ConvexData, 3> data = {ConvexData(mesh_sizes[0]), ConvexData(mesh_sizes[1]),
                                                   ConvexData(mesh_sizes[2])};
    return data[nearest_mesh(size)];
}

} // namespace

dTriMeshDataID mesh_data(dReal size)
{
    static const MeshData data[] = {MeshData(mesh_sizes[0]), MeshData(mesh_sizes[1]), MeshData(mesh_sizes[2])};
    return data[nearest_mesh(size)].id;
}

namespace
{
dHeightfieldDataID height_data(dReal size, bool endless)
{
    static const HeightData finite[] = {{mesh_sizes[0], false}, {mesh_sizes[1], false}, {mesh_sizes[2], false}};
    static const HeightData wrapped[] = {{mesh_sizes[0], true}, {mesh_sizes[1], true}, {mesh_sizes[2], true}};
    return (endless ? wrapped : finite)[nearest_mesh(size)].id;
}

// The user class: a ball with its radius as class data, one and a half radii away from its position along x.
dReal &ball_radius(dGeomID geom)
{
    return *static_cast<dReal *>(dGeomGetClassData(geom));
}

void ball_centre(dGeomID geom, dVector3 centre)
{
    dGeomGetRelPointPos(geom, 1.5 * ball_radius(geom), 0, 0, centre);
}

int calls_until_throw = -1; // calls of ball_bounds(); negative: none throws

void ball_bounds(dGeomID geom, dReal aabb[6])
{
    if (calls_until_throw >= 0 && calls_until_throw-- == 0)
        throw ThrowingBounds::Thrown();
    dVector3 centre;
    ball_centre(geom, centre);
    for (int axis = 0; axis < 3; ++axis)
    {
        aabb[2 * axis] = centre[axis] - ball_radius(geom);
        aabb[2 * axis + 1] = centre[axis] + ball_radius(geom);
    }
}

// The ball against the other's box: no contact if they overlap only at the corners of the ball's box.
int ball_may_touch(dGeomID geom, dGeomID, dReal aabb[6])
{
    dVector3 centre;
    ball_centre(geom, centre);
    dReal squared = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        const dReal nearest = std::fmin(std::fmax(centre[axis], aabb[2 * axis]), aabb[2 * axis + 1]);
        squared += (nearest - centre[axis]) * (nearest - centre[axis]);
    }
    return !(squared > ball_radius(geom) * ball_radius(geom));
}

dColliderFn *no_collider(int)
{
    return nullptr;
}

int ball_class()
{
    static const int number = [] {
        dGeomClass ball = {sizeof(dReal), no_collider, ball_bounds, ball_may_touch, nullptr};
        return dCreateGeomClass(&ball);
    }();
    return number;
}

dGeomID create_ball(dReal size, dSpaceID space)
{
    dGeomID geom = dCreateGeom(ball_class());
    ball_radius(geom) = size / 2;
    if (space)
        dSpaceAdd(space, geom);
    return geom;
}

// dGeomTriMeshSetData() marks the geom dirty without a notice, so that a space would miss later moves: it leaves its space.
void set_mesh(dGeomID geom, dTriMeshDataID data)
{
    dSpaceID space = dGeomGetSpace(geom);
    if (space)
        dSpaceRemove(space, geom);
    dGeomTriMeshSetData(geom, data);
    if (space)
        dSpaceAdd(space, geom);
}

void fill_transform(dGeomID transform, dReal size)
{
    dGeomID inner = dCreateSphere(nullptr, size / 2);
    dGeomSetPosition(inner, 0, size, 0);
    dGeomTransformSetGeom(transform, inner);
}

dGeomID create_transform(dReal size, dSpaceID space)
{
    dGeomID transform = dCreateGeomTransform(space);
    dGeomTransformSetCleanup(transform, 1);
    fill_transform(transform, size);
    return transform;
}

dGeomID create_convex(dReal size, dSpaceID space)
{
    const ConvexData &data = convex_data(size);
    return dCreateConvex(space, data.planes.data(), 6, data.points.data(), 8, ConvexData::polygons());
}

class OwnConvex : public OwnShapeData
{
public:
    explicit OwnConvex(dReal size) : data_(size) {}
    void give_to(dGeomID geom) const override { data_.give_to(geom); }
    void resize(dReal size) override { data_.set_size(size); }

private:
    ConvexData data_;
};

class OwnMesh : public OwnShapeData
{
public:
    explicit OwnMesh(dReal size) : data_(size) {}
    void give_to(dGeomID geom) const override { set_mesh(geom, data_.id); }
    void resize(dReal size) override { data_.set_size(size); }

private:
    MeshData data_;
};
} // namespace

std::unique_ptr<OwnShapeData> make_own_data(GeomKind kind, dReal size)
{
    if (kind == GeomKind::convex)
        return std::make_unique<OwnConvex>(size);
    if (kind == GeomKind::trimesh)
        return std::make_unique<OwnMesh>(size);
    return nullptr;
}

ThrowingBounds::ThrowingBounds(int spared)
{
    calls_until_throw = spared;
}

ThrowingBounds::~ThrowingBounds()
{
    calls_until_throw = -1;
}

const char *geom_kind_name(GeomKind kind)
{
    static const char *const names[geom_kind_count] = {"sphere",
                                                       "box",
                                                       "capsule",
                                                       "cylinder",
                                                       "ray",
                                                       "convex",
                                                       "trimesh",
                                                       "heightfield",
                                                       "transform",
                                                       "user",
                                                       "plane",
                                                       "oblique_plane",
                                                       "endless_heightfield"};
    return names[static_cast<int>(kind)];
}

bool is_placeable(GeomKind kind)
{
    return kind != GeomKind::plane && kind != GeomKind::oblique_plane && kind != GeomKind::endless_heightfield;
}

dGeomID create_geom(GeomKind kind, dReal size, dSpaceID space)
{
    switch (kind)
    {
    case GeomKind::sphere:
        return dCreateSphere(space, size / 2);
    case GeomKind::box:
        return dCreateBox(space, size, size / 2, 1.5 * size);
    case GeomKind::capsule:
        return dCreateCapsule(space, size / 4, size);
    case GeomKind::cylinder:
        return dCreateCylinder(space, size / 2, size / 2);
    case GeomKind::ray:
        return dCreateRay(space, 2 * size);
    case GeomKind::convex:
        return create_convex(size, space);
    case GeomKind::trimesh:
        return dCreateTriMesh(space, mesh_data(size), nullptr, nullptr, nullptr);
    case GeomKind::heightfield:
        return dCreateHeightfield(space, height_data(size, false), 1);
    case GeomKind::transform:
        return create_transform(size, space);
    case GeomKind::user:
        return create_ball(size, space);
    case GeomKind::plane:
        return dCreatePlane(space, 0, 0, 1, -size);
    case GeomKind::oblique_plane:
        return dCreatePlane(space, 0.6, 0, 0.8, -size);
    case GeomKind::endless_heightfield:
        break;
    }
    return dCreateHeightfield(space, height_data(size, true), 0);
}

void resize_geom(dGeomID geom, GeomKind kind, dReal size)
{
    switch (kind)
    {
    case GeomKind::sphere:
        return dGeomSphereSetRadius(geom, size / 2);
    case GeomKind::box:
        return dGeomBoxSetLengths(geom, size, size / 2, 1.5 * size);
    case GeomKind::capsule:
        return dGeomCapsuleSetParams(geom, size / 4, size);
    case GeomKind::cylinder:
        return dGeomCylinderSetParams(geom, size / 2, size / 2);
    case GeomKind::ray:
        return dGeomRaySetLength(geom, 2 * size);
    case GeomKind::plane:
        return dGeomPlaneSetParams(geom, 0, 0, 1, -size);
    case GeomKind::oblique_plane:
        return dGeomPlaneSetParams(geom, 0.6, 0, 0.8, -size);
    case GeomKind::endless_heightfield:
        // No change of these geoms would show in their bounds.
        return;
    case GeomKind::convex:
        convex_data(size).give_to(geom);
        break;
    case GeomKind::trimesh:
        set_mesh(geom, mesh_data(size));
        break;
    case GeomKind::heightfield:
        dGeomHeightfieldSetHeightfieldData(geom, height_data(size, false));
        break;
    case GeomKind::transform:
        fill_transform(geom, size);
        break;
    case GeomKind::user:
        ball_radius(geom) = size / 2;
        break;
    }
    dVector3 position;
    dGeomCopyPosition(geom, position);
    dGeomSetPosition(geom, position[0], position[1], position[2]);
}
} // namespace ode_predictive_space
