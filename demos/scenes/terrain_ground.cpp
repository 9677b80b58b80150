#include "demos/scenes/terrain_ground.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr unsigned long ground_category = 2;
constexpr int samples_along = 201;
constexpr int samples_across = 9;
constexpr double heightfield_thickness = 0.5; // metres

double along(int sample)
{
    return terrain_length * (static_cast<double>(sample) / (samples_along - 1) - 0.5);
}
} // namespace

TerrainGround::TerrainGround(double half_side)
    : half_side_(half_side), heightfield_(dGeomHeightfieldDataCreate()), mesh_(dGeomTriMeshDataCreate())
{
    make_heightfield();
    make_mesh();
}

TerrainGround::~TerrainGround()
{
    dGeomTriMeshDataDestroy(mesh_);
    dGeomHeightfieldDataDestroy(heightfield_);
}

double TerrainGround::height(double x, double y) const
{
    const double share = std::clamp((half_side_ / 3 - y) / half_side_, 0.0, 1.0);
    const double fade = share * share * (3 - 2 * share);
    return fade * (0.5 + 0.25 * std::sin(x / 15) + 0.25 * std::sin(x / 9 + y / 20));
}

// ODE's heightfields have y upwards; turned upright by a quarter about x, their z runs against our y.
void TerrainGround::make_heightfield()
{
    const double strip = 2 * half_side_ / 3;
    std::vector<double> samples;
    for (int row = 0; row < samples_across; ++row)
    {
        const double y = -half_side_ / 3 - strip * row / (samples_across - 1);
        for (int column = 0; column < samples_along; ++column)
            samples.push_back(height(along(column), y));
    }
    constexpr int copies = 1;
    constexpr int repeats = 0;
    dGeomHeightfieldDataBuildDouble(heightfield_, samples.data(), copies, terrain_length, strip, samples_along,
                                    samples_across, 1, 0, heightfield_thickness, repeats);
}

void TerrainGround::make_mesh()
{
    for (int row = 0; row < samples_across; ++row)
    {
        const double y = half_side_ * (2.0 * row / (samples_across - 1) - 1) / 3;
        for (int column = 0; column < samples_along; ++column)
        {
            const double x = along(column);
            vertices_.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(height(x, y))});
        }
    }
    for (dTriIndex row = 0; row + 1 < samples_across; ++row)
    {
        for (dTriIndex column = 0; column + 1 < samples_along; ++column)
        {
            const dTriIndex corner = row * samples_along + column;
            triangles_.push_back({corner, corner + 1, corner + samples_along});
            triangles_.push_back({corner + 1, corner + samples_along + 1, corner + samples_along});
        }
    }
    dGeomTriMeshDataBuildSingle(mesh_, vertices_.data(), sizeof(Vertex), static_cast<int>(vertices_.size()),
                                triangles_.data(), static_cast<int>(3 * triangles_.size()), sizeof(Triangle));
}

void TerrainGround::add_geoms(SceneObjects &objects) const
{
    const dGeomID heightfield = objects.add_geom(dCreateHeightfield(objects.space(), heightfield_, 1));
    set_position(heightfield, {0, -2 * half_side_ / 3, 0});
    set_orientation(heightfield, Quaternion(Eigen::AngleAxisd(pi / 2, Vector3::UnitX())));
    const dGeomID mesh = objects.add_geom(dCreateTriMesh(objects.space(), mesh_, nullptr, nullptr, nullptr));
    const dGeomID plane = objects.add_geom(dCreatePlane(objects.space(), 0, 0, 1, 0));
    for (const dGeomID geom : {heightfield, mesh, plane})
    {
        dGeomSetCategoryBits(geom, ground_category);
        dGeomSetCollideBits(geom, ~ground_category);
    }
}
} // namespace ode_predictive_space::scenes
