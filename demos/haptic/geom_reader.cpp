#include "demos/haptic/geom_reader.h"

#include "demos/haptic/room.h"

#include <algorithm>

namespace ode_predictive_space::demo
{
namespace
{
using window::Part;
using window::Solid;
using window::Triangles;
using window::Vector3;
using worlds::bounds_of;

void read_pose(dGeomID geom, window::DrawnGeom &drawn)
{
    std::copy_n(dGeomGetPosition(geom), 3, drawn.position.begin());
    std::copy_n(dGeomGetRotation(geom), 12, drawn.rotation.begin());
}

void read_body(dBodyID body, window::DrawnGeom &drawn)
{
    if (body != nullptr)
    {
        drawn.part = dBodyIsEnabled(body) != 0 ? Part::moving : Part::asleep;
        std::copy_n(dBodyGetLinearVel(body), 3, drawn.velocity.begin());
    }
}

/// The box that ODE would report, for shapes that are not drawn themselves.
void read_bounds(dGeomID geom, window::DrawnGeom &drawn)
{
    const Eigen::AlignedBox3d box = bounds_of(geom);
    drawn.solid = Solid::bounds;
    Vector3::Map(drawn.size.data()) = box.sizes();
    Vector3::Map(drawn.position.data()) = box.center();
    drawn.rotation = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    drawn.radius = box.diagonal().norm() / 2;
}

constexpr int cells_of_hills = 96; ///< drawn along each side

/// A lattice on the ground. ODE has no function for the heights, so rays find them; a ray on a line between samples may miss.
std::vector<Vector3> lattice_on(dGeomID heightfield)
{
    constexpr double within = 0.997;
    const Eigen::AlignedBox3d box = bounds_of(heightfield);
    const Vector3 corner = box.center() - within / 2 * box.sizes(), cell = within * box.sizes() / cells_of_hills;
    const double above = box.max().z() + 1;
    const dGeomID ray = dCreateRay(nullptr, above - box.min().z());
    std::vector<Vector3> lattice;
    double height = box.center().z();
    for (int i = 0; i <= cells_of_hills; ++i)
    {
        for (int j = 0; j <= cells_of_hills; ++j)
        {
            const double x = corner.x() + i * cell.x(), y = corner.y() + j * cell.y();
            dGeomRaySet(ray, x, y, above, 0, 0, -1);
            dContactGeom contact;
            height = dCollide(ray, heightfield, 1, &contact, sizeof contact) > 0 ? contact.pos[2] : height;
            lattice.emplace_back(x, y, height);
        }
    }
    dGeomDestroy(ray);
    return lattice;
}

Triangles triangles_between(const std::vector<Vector3> &lattice)
{
    constexpr int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    Triangles triangles;
    for (int i = 0; i < cells_of_hills; ++i)
    {
        for (int j = 0; j < cells_of_hills; ++j)
        {
            for (const auto &[along, across] : corners)
            {
                const int number = (i + along) * (cells_of_hills + 1) + j + across;
                const Vector3 &corner = lattice[static_cast<std::size_t>(number)];
                triangles.insert(triangles.end(), corner.data(), corner.data() + 3);
            }
        }
    }
    return triangles;
}
} // namespace

GeomReader::GeomReader(const worlds::World &scene, const Eigen::AlignedBox3d &room)
    : scene_(scene), wall_size_(room.sizes().minCoeff() / 2)
{
    for (const dGeomID geom : scene.geoms())
    {
        if (geom != nullptr && dGeomGetClass(geom) == dHeightfieldClass)
            hills_[geom] = std::make_shared<const Triangles>(triangles_between(lattice_on(geom)));
    }
}

bool GeomReader::read(std::size_t most, std::vector<window::DrawnGeom> &geoms)
{
    if (next_ == 0)
        geoms.clear();
    const std::vector<dGeomID> &all = scene_.geoms();
    const std::size_t end = next_ + std::min(most, all.size() - next_);
    for (; next_ < end; ++next_)
    {
        if (all[next_] != nullptr)
            geoms.push_back(drawn(all[next_]));
    }
    const bool complete = next_ >= all.size();
    next_ = complete ? 0 : next_;
    return complete;
}

bool GeomReader::is_wall(dGeomID geom) const
{
    return dGeomGetBody(geom) == nullptr && bounds_of(geom).sizes().maxCoeff() > wall_size_;
}

window::DrawnGeom GeomReader::drawn(dGeomID geom)
{
    window::DrawnGeom result;
    result.id = id_of(geom);
    if (const auto hills = hills_.find(geom); hills != hills_.end())
    {
        read_bounds(geom, result);
        result.position = {};
        result.part = Part::ground;
        result.solid = Solid::mesh;
        result.triangles = hills->second;
        return result;
    }
    if (dGeomGetClass(geom) == dPlaneClass || is_wall(geom))
    {
        result.part = Part::wall;
        return result;
    }
    read_pose(geom, result);
    read_body(dGeomGetBody(geom), result);
    switch (dGeomGetClass(geom))
    {
    case dSphereClass:
        result.solid = Solid::sphere;
        result.size[0] = dGeomSphereGetRadius(geom);
        result.radius = result.size[0];
        break;
    case dBoxClass:
    {
        dVector3 sides;
        dGeomBoxGetLengths(geom, sides);
        result.solid = Solid::box;
        std::copy_n(sides, 3, result.size.begin());
        result.radius = Vector3::Map(sides).norm() / 2;
        break;
    }
    case dCapsuleClass:
        result.solid = Solid::capsule;
        dGeomCapsuleGetParams(geom, &result.size[0], &result.size[1]);
        result.radius = result.size[0] + result.size[1] / 2;
        break;
    case dCylinderClass:
        result.solid = Solid::cylinder;
        dGeomCylinderGetParams(geom, &result.size[0], &result.size[1]);
        result.radius = std::hypot(result.size[0], result.size[1] / 2);
        break;
    case dTriMeshClass:
        result.solid = Solid::mesh;
        result.triangles = triangles_of(geom);
        result.radius = bounds_of(geom).sizes().maxCoeff() / 2;
        break;
    default:
        read_bounds(geom, result);
    }
    return result;
}

std::shared_ptr<const Triangles> GeomReader::triangles_of(dGeomID mesh)
{
    std::shared_ptr<const Triangles> &kept = meshes_[dGeomTriMeshGetData(mesh)];
    if (kept == nullptr)
    {
        // ODE gives a mesh's triangles in the scene's frame.
        const Eigen::Map<const Eigen::Matrix<dReal, 3, 4, Eigen::RowMajor>> rotation(dGeomGetRotation(mesh));
        const Eigen::Map<const Eigen::Matrix<dReal, 3, 1>> position(dGeomGetPosition(mesh));
        Triangles triangles;
        for (int i = 0; i < dGeomTriMeshGetTriangleCount(mesh); ++i)
        {
            dVector3 corners[3];
            dGeomTriMeshGetTriangle(mesh, i, &corners[0], &corners[1], &corners[2]);
            for (const dVector3 &corner : corners)
            {
                const Vector3 local = rotation.leftCols<3>().transpose() * (Vector3::Map(corner) - position);
                triangles.insert(triangles.end(), local.data(), local.data() + 3);
            }
        }
        kept = std::make_shared<const Triangles>(std::move(triangles));
    }
    return kept;
}
} // namespace ode_predictive_space::demo
