// Trees of meshes near the probe, and of heightfields with known samples: one for each data.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MESH_STORE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MESH_STORE_H

#include "ode_predictive_space/haptics/contact/mesh_tree.h"

#include <memory>
#include <ode/collision.h>
#include <ode/collision_trimesh.h>
#include <string_view>

namespace ode_predictive_space::haptics
{
struct HeightfieldSamples;

constexpr std::string_view reading_notice =
    "A mesh is being read, a part in each tick. Until it is complete, its contacts are those of dCollide().";

struct TriangleList
{
    std::array<int, 8> indices{};
    int count = 0;

    void add(int triangle)
    {
        if (count < static_cast<int>(indices.size()))
            indices[count++] = triangle;
    }
};

/// Geoms of the same dTriMeshDataID share a tree. ODE does not report changed triangles: each look-up compares their number, a
/// few of them in rotation, and the touched ones. A difference replaces the tree. A large mesh is read in parts, so that no
/// look-up takes long. A heightfield has the triangles of its cells. ODE gives no access to its samples, so it is not compared.
class MeshStore
{
public:
    /// Triangle meshes that have data, and heightfields that have samples.
    bool knows(dGeomID geom) const;

    /// Begins a tick with a budget of steps of MeshTree::build().
    void begin(std::size_t steps);

    bool is_reading() const { return is_reading_; }

    /// @return 0 while it is being read.
    std::shared_ptr<const MeshTree> tree_of(dGeomID geom, const TriangleList &touched);

    void prepare(dGeomID mesh);

    /// @throws std::invalid_argument when the samples make no field.
    void set_samples(dHeightfieldDataID data, const HeightfieldSamples &samples);
    void forget_samples(dHeightfieldDataID data);

    /// Drops the tree. It is read again when it is needed.
    void forget(dTriMeshDataID data);

    std::size_t count() const { return meshes_.size(); }

private:
    struct Entry
    {
        const void *data;
        std::shared_ptr<MeshTree> tree;
        std::size_t next = 0; ///< triangle to compare next
    };

    static constexpr std::size_t unlimited = ~std::size_t{0};

    Entry &entry_of(dGeomID mesh);
    void read(const void *data, MeshTree &tree);
    static bool is_current(dGeomID geom, Entry &entry, const TriangleList &touched);

    std::vector<Entry> meshes_;
    std::vector<Entry> fields_;
    std::size_t steps_ = unlimited; ///< left in this tick
    bool is_reading_ = false;
};
} // namespace ode_predictive_space::haptics

#endif
