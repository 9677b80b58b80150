// The triangles of a mesh, with their neighbours: what of the mesh is near a point, and whether the point is inside.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MESH_TREE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MESH_TREE_H

#include "ode_predictive_space/haptics/contact/solid.h"
#include "ode_predictive_space/surface/triangle_tree.h"

namespace ode_predictive_space::haptics
{
/// A copy of a mesh's triangles, in the mesh's frame. It does not change, so that geoms and threads may share it.
///
/// The surface has two sides: which one is felt depends on where the point is, never on the order of a triangle's corners.
/// Holes, triangles that are there twice and triangles without area are no special cases.
class MeshTree
{
public:
    /// Counts the triangles that searches visit, and ends a search that exceeds it.
    class Budget
    {
    public:
        explicit Budget(std::size_t triangles) : left_(triangles) {}

        /// @return false, from now on, when none is left.
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

    std::size_t count() const { return tree_.count(); }
    TriangleCorners corners(std::size_t triangle) const { return tree_.corners(static_cast<std::uint32_t>(triangle)); }

    /// Append the local minima of the distance within a radius, in no order. A place of an edge or of a corner is one only
    /// if no triangle at that edge or corner comes nearer: on a flat floor there is one feature, however many triangles it
    /// is made of.
    ///
    /// @return the distance to the mesh; the radius when nothing is within it. When the budget is exceeded, it and the features are
    /// those of the triangles that were visited.
    ///
    /// @param budget may be 0: then there is no limit.
    double collect(const Vector3 &point, double radius, SurfaceFeatures &features, Budget *budget = nullptr) const;

    /// The distance from a point to the mesh, or `most` if that is less.
    double distance(const Vector3 &point, double most) const;

    /// How often the mesh winds around a point: 1 inside of a closed mesh whose triangles face outwards, -1 where they face
    /// inwards, 0 outside. Holes and far triangles make it inexact by some hundredths. (Jacobson, Kavan and Sorkine-Hornung,
    /// 2013; Barill and others, 2018.)
    double winding_number(const Vector3 &point) const;

    /// The place of one triangle that is nearest to a point.
    SurfaceFeature nearest_of(std::size_t triangle, const Vector3 &point) const;

private:
    /// A node's triangles as seen from afar.
    struct Dipole
    {
        Vector3 centre = Vector3::Zero(); ///< m
        Vector3 area = Vector3::Zero();   ///< m^2; the sum of the triangles' normals, each as long as its area
        double size = 0;                  ///< m^2; the sum of the areas
        double radius = 0;                ///< m; about the centre, of a ball that holds the node's box
    };

    TriangleArrays weld(const std::vector<TriangleCorners> &triangles);
    void list_fans();
    void list_dipoles();
    Dipole sum_of(const TriangleTree::Node &node) const;
    bool is_minimum(const NearestOnTriangle &nearest, std::uint32_t triangle, const Vector3 &point) const;
    std::uint32_t fan_size(std::uint32_t vertex) const { return fan_begin_[vertex + 1] - fan_begin_[vertex]; }
    double add(const Vector3 &point, std::uint32_t triangle, double radius, std::size_t first,
               SurfaceFeatures &features) const;

    std::vector<Vector3> vertices_;
    std::vector<TriangleArrays::Indices> triangles_;
    TriangleTree tree_;                    ///< of those that are finite; reads the two above
    std::vector<std::uint32_t> fan_begin_; ///< by vertex: where its triangles begin in fans_
    std::vector<std::uint32_t> fans_;
    std::vector<Dipole> dipoles_; ///< by node of tree_
};
} // namespace ode_predictive_space::haptics

#endif
