#include "ode_predictive_space/haptics/contact/mesh_store.h"

#include "ode_predictive_space/haptics/contact/ode_vector.h"
#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/touch.h"

#include <stdexcept>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::size_t most_meshes = 256; // then the oldest one is dropped
constexpr int compared_at_once = 8;
constexpr std::size_t steps_to_add = 8; // of MeshTree::build(): adding a triangle takes as long
constexpr double rounding_of_corners = sizeof(dReal) == sizeof(double) ? 1e-9 : 1e-5; // m, and of the coordinates

TriangleCorners triangle_of(dGeomID geom, int index)
{
    dVector3 corners[3];
    dGeomTriMeshGetTriangle(geom, index, &corners[0], &corners[1], &corners[2]);
    return {from_ode(corners[0]), from_ode(corners[1]), from_ode(corners[2])};
}

/// Diagonals run from the corner with the higher x to the one with the higher z, as in ODE. Triangles face upwards.
std::vector<TriangleCorners> triangles_of(const HeightfieldSamples &samples)
{
    const auto columns = static_cast<std::size_t>(std::max(0, samples.width_samples));
    const auto rows = static_cast<std::size_t>(std::max(0, samples.depth_samples));
    if (!(samples.width > 0 && samples.depth > 0 && columns >= 2 && rows >= 2) ||
        samples.heights.size() != columns * rows)
        throw std::invalid_argument("A heightfield needs a width and a depth, and a height for each of its samples");
    const auto part = [](std::size_t i, std::size_t count) {
        return static_cast<double>(i) / static_cast<double>(count - 1) - 0.5;
    };
    const auto at = [&](std::size_t x, std::size_t z) -> Vector3 {
        return {samples.width * part(x, columns), samples.scale * samples.heights[x + z * columns] + samples.offset,
                samples.depth * part(z, rows)};
    };
    std::vector<TriangleCorners> triangles;
    for (std::size_t z = 0; z + 1 < rows; ++z)
    {
        for (std::size_t x = 0; x + 1 < columns; ++x)
        {
            triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
            triangles.push_back({at(x + 1, z + 1), at(x + 1, z), at(x, z + 1)});
        }
    }
    return triangles;
}

std::shared_ptr<MeshTree> unread_tree_of(dGeomID mesh)
{
    return std::make_shared<MeshTree>(MeshTree::Unread(), static_cast<std::size_t>(dGeomTriMeshGetTriangleCount(mesh)));
}

bool is_same(dGeomID geom, const MeshTree &tree, std::size_t triangle)
{
    const TriangleCorners in_scene = triangle_of(geom, static_cast<int>(triangle));
    const TriangleCorners in_tree = tree.corners(triangle);
    for (int i = 0; i < 3; ++i)
    {
        dVector3 expected;
        dGeomGetRelPointPos(geom, static_cast<dReal>(in_tree[i].x()), static_cast<dReal>(in_tree[i].y()),
                            static_cast<dReal>(in_tree[i].z()), expected);
        const double allowed = rounding_of_corners * (1 + in_scene[i].norm() + in_tree[i].norm());
        const bool is_far = !((from_ode(expected) - in_scene[i]).norm() <= allowed);
        if (is_far && (in_scene[i].allFinite() || in_tree[i].allFinite()))
            return false;
    }
    return true;
}

auto is_of(const void *data)
{
    return [data](const auto &entry) { return entry.data == data; };
}
} // namespace

bool MeshStore::knows(dGeomID geom) const
{
    const int kind = dGeomGetClass(geom);
    return (kind == dTriMeshClass && dGeomTriMeshGetData(geom) != nullptr) ||
           (kind == dHeightfieldClass && find_in(fields_, is_of(dGeomHeightfieldGetHeightfieldData(geom))) != nullptr);
}

void MeshStore::begin(std::size_t steps)
{
    steps_ = steps;
    is_reading_ = false;
}

std::shared_ptr<const MeshTree> MeshStore::tree_of(dGeomID geom, const TriangleList &touched)
{
    if (dGeomGetClass(geom) == dHeightfieldClass)
        return find_in(fields_, is_of(dGeomHeightfieldGetHeightfieldData(geom)))->tree;
    Entry &entry = entry_of(geom);
    if (!is_current(geom, entry, touched))
        entry.tree = unread_tree_of(geom);
    if (!entry.tree->is_ready())
        read(entry.data, *entry.tree);
    if (entry.tree->is_ready())
        return entry.tree;
    is_reading_ = true;
    return nullptr;
}

void MeshStore::prepare(dGeomID mesh)
{
    const std::size_t steps = std::exchange(steps_, unlimited);
    tree_of(mesh, {});
    steps_ = steps;
}

MeshStore::Entry &MeshStore::entry_of(dGeomID mesh)
{
    const dTriMeshDataID data = dGeomTriMeshGetData(mesh);
    if (Entry *known = find_in(meshes_, is_of(data)))
        return *known;
    if (meshes_.size() == most_meshes)
        meshes_.erase(meshes_.begin());
    meshes_.push_back({data, unread_tree_of(mesh)});
    return meshes_.back();
}

/// Reads by a temporary geom at the origin, where ODE returns the coordinates unchanged. The data may be destroyed afterwards.
void MeshStore::read(const void *data, MeshTree &tree)
{
    if (tree.added() < tree.count() && steps_ >= steps_to_add)
    {
        const dGeomID geom =
            dCreateTriMesh(nullptr, static_cast<dTriMeshDataID>(const_cast<void *>(data)), nullptr, nullptr, nullptr);
        for (; steps_ >= steps_to_add && tree.added() < tree.count(); steps_ -= steps_to_add)
            tree.add(triangle_of(geom, static_cast<int>(tree.added())));
        dGeomDestroy(geom);
    }
    if (tree.added() == tree.count())
        steps_ = tree.build(steps_);
}

void MeshStore::set_samples(dHeightfieldDataID data, const HeightfieldSamples &samples)
{
    Entry field = {data, std::make_shared<MeshTree>(triangles_of(samples))};
    forget_samples(data);
    fields_.push_back(std::move(field));
}

void MeshStore::forget_samples(dHeightfieldDataID data)
{
    remove_from(fields_, is_of(data));
}

void MeshStore::forget(dTriMeshDataID data)
{
    remove_from(meshes_, is_of(data));
}

bool MeshStore::is_current(dGeomID geom, Entry &entry, const TriangleList &touched)
{
    const std::size_t count = entry.tree->count();
    if (static_cast<std::size_t>(dGeomTriMeshGetTriangleCount(geom)) != count)
        return false;
    if (!entry.tree->is_ready())
        return true;
    for (int i = 0; i < compared_at_once && count > 0; ++i)
    {
        entry.next = (entry.next + 1) % count;
        if (!is_same(geom, *entry.tree, entry.next))
            return false;
    }
    return std::all_of(touched.indices.begin(), touched.indices.begin() + touched.count, [&](int triangle) {
        return static_cast<std::size_t>(triangle) >= count ||
               is_same(geom, *entry.tree, static_cast<std::size_t>(triangle));
    });
}
} // namespace ode_predictive_space::haptics
