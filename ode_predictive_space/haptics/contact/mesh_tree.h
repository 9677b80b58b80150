// The triangles of a mesh: features near a point, and whether the point is inside.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MESH_TREE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MESH_TREE_H

#include "ode_predictive_space/haptics/contact/solid.h"
#include "ode_predictive_space/haptics/contact/vertex_table.h"
#include "ode_predictive_space/surface/triangle_tree.h"

#include <optional>

namespace ode_predictive_space::haptics
{
/// A copy of a mesh's triangles, in the mesh's frame. It is immutable once it is ready, so geoms and threads may share it. A
/// large mesh is built in parts: add() for each triangle, then build() until is_ready(). Queries need a ready tree. The surface
/// has two sides, whatever the order of the corners. Holes, duplicate triangles and triangles without area are allowed.
class MeshTree
{
public:
    /// Counts the triangles that searches visit, and ends a search that exceeds it.
    class Budget
    {
    public:
        explicit Budget(std::size_t triangles) : left_(triangles) {}

        bool take()
        {
            is_exceeded_ = is_exceeded_ || left_ == 0;
            left_ -= is_exceeded_ ? 0 : 1;
            return !is_exceeded_;
        }

        std::size_t left() const { return left_; }
        bool is_exceeded() const { return is_exceeded_; }

    private:
        std::size_t left_;
        bool is_exceeded_ = false;
    };

    explicit MeshTree(const std::vector<TriangleCorners> &triangles);

    struct Unread
    {};

    MeshTree(Unread, std::size_t count);

    void add(const TriangleCorners &corners);

    std::size_t added() const { return triangles_.size(); }

    /// Builds after the last add(). @return the remaining steps. A step takes some 25 ns.
    std::size_t build(std::size_t steps);

    bool is_ready() const { return tree_ && tree_->is_ready() && dipoles_.size() == tree_->nodes().size(); }

    std::size_t count() const { return count_; }
    TriangleCorners corners(std::size_t triangle) const { return tree_->corners(static_cast<std::uint32_t>(triangle)); }

    /// Appends the local minima of the distance within a radius, in no order. A place on an edge or corner counts only if no
    /// adjacent triangle is nearer: a flat floor has one feature, however many triangles it has.
    /// @return the distance to the mesh, at most the radius. When the budget is exceeded, distance and features are those of
    ///         the visited triangles.
    double collect(const Vector3 &point, double radius, SurfaceFeatures &features, Budget *budget = nullptr) const;

    double distance(const Vector3 &point, double most) const;

    /// The winding number: 1 inside of a closed mesh whose triangles face outwards, -1 where they face inwards, 0 outside.
    /// Holes and far triangles add errors of hundredths. (Jacobson, Kavan and Sorkine-Hornung, 2013; Barill and others, 2018.)
    double winding_number(const Vector3 &point) const;

    SurfaceFeature nearest_of(std::size_t triangle, const Vector3 &point) const;

private:
    struct Dipole
    {
        Vector3 centre = Vector3::Zero(); ///< m
        Vector3 area = Vector3::Zero();   ///< m^2; the sum of the triangles' normals, each as long as its area
        double size = 0;                  ///< m^2; the sum of the areas
        double radius = 0;                ///< m; about the centre, of a ball that holds the node's box
    };

    /// The triangles at a vertex, as a list in fan_next_ of their corners: corner i of triangle t is 3 t + i.
    struct Fan
    {
        std::uint32_t first = end_of_fan;
        std::uint32_t size = 0;
    };

    static constexpr std::uint32_t end_of_fan = ~std::uint32_t{0};

    void begin_tree();
    void add_dipole();
    const Dipole &dipole_of(std::uint32_t node) const { return dipoles_[tree_->nodes().size() - 1 - node]; }
    Dipole sum_of(const TriangleTree::Node &node) const;
    bool is_minimum(const NearestOnTriangle &nearest, std::uint32_t triangle, const Vector3 &point) const;
    double add(const Vector3 &point, std::uint32_t triangle, double radius, std::size_t first,
               SurfaceFeatures &features) const;

    std::size_t count_;
    std::vector<Vector3> vertices_;
    std::vector<TriangleArrays::Indices> triangles_;
    std::vector<Fan> fans_;               ///< by vertex
    std::vector<std::uint32_t> fan_next_; ///< by corner
    std::unique_ptr<VertexTable> known_;  ///< while triangles are added
    std::vector<std::uint32_t> finite_;   ///< triangles whose corners are numbers, until the tree has them
    std::optional<TriangleTree> tree_;    ///< of the finite ones; reads vertices and triangles
    std::vector<Dipole> dipoles_;         ///< by node of the tree, the last one first
};
} // namespace ode_predictive_space::haptics

#endif
