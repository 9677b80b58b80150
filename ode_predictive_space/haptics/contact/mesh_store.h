// The trees of the meshes that a probe has come near: one for each mesh data.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MESH_STORE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MESH_STORE_H

#include "ode_predictive_space/haptics/contact/mesh_tree.h"

#include <memory>
#include <ode/collision.h>
#include <ode/collision_trimesh.h>

namespace ode_predictive_space::haptics
{
/// A few triangles of a mesh.
struct TriangleList
{
    std::array<int, 8> indices{};
    int count = 0;

    void add(int triangle)
    {
        if (count < static_cast<int>(indices.size()))
        {
            indices[count++] = triangle;
        }
    }
};

/// Geoms of the same dTriMeshDataID share a tree. ODE does not tell when the triangles behind an id change: each look-up compares
/// their number, some of them in turn, and those that the caller names, and makes the tree anew when one differs.
class MeshStore
{
public:
    /// @param geom a triangle mesh.
    /// @param touched triangles of it to compare now.
    std::shared_ptr<const MeshTree> tree_of(dGeomID geom, const TriangleList &touched);

    /// Make the tree anew when it is needed next.
    void forget(dTriMeshDataID data);

    std::size_t count() const { return entries_.size(); }

private:
    struct Entry
    {
        dTriMeshDataID data;
        std::shared_ptr<const MeshTree> tree;
        std::size_t next = 0; ///< triangle to compare next
    };

    bool is_current(dGeomID geom, Entry &entry, const TriangleList &touched) const;

    std::vector<Entry> entries_;
};
} // namespace ode_predictive_space::haptics

#endif
