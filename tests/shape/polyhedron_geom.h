#ifndef ODE_PREDICTIVE_SPACE_TESTS_SHAPE_POLYHEDRON_GEOM_H
#define ODE_PREDICTIVE_SPACE_TESTS_SHAPE_POLYHEDRON_GEOM_H

#include <functional>
#include <vector>

#include <ode/ode.h>

#include <Eigen/Core>

namespace ode_predictive_space
{
/// Corners, and faces as lists of corners, counterclockwise seen from outside.
struct Polyhedron
{
    std::vector<Eigen::Vector3d> corners;
    std::vector<std::vector<unsigned>> faces;

    static Polyhedron cube();        ///< with sides of 2
    static Polyhedron octahedron();  ///< with a height of 2
    static Polyhedron tetrahedron(); ///< inside the cube
    static Polyhedron square();      ///< with sides of 2 and one face
    /// Two triangles for each cell of a grid; its corners are at point(x, y), with x and y from 0 to 1.
    static Polyhedron sheet(unsigned columns, unsigned rows,
                            const std::function<Eigen::Vector3d(double, double)> &point);

    void add(const Polyhedron &other);

    Polyhedron changed(const Eigen::Vector3d &factors, const Eigen::Vector3d &by) const;
};

/// The arrays of a dConvex; they must outlive the geom.
class ConvexArrays
{
public:
    explicit ConvexArrays(const Polyhedron &polyhedron);
    dGeomID create(dSpaceID space) const;
    void give_to(dGeomID convex) const;
    void move_points(const Eigen::Vector3d &by);
    /// Changes points and planes in place, to those of a polyhedron with the same faces.
    void change(const Polyhedron &polyhedron);

private:
    std::vector<dReal> points_;
    std::vector<dReal> planes_;
    std::vector<unsigned> polygons_;
};

/// The data of a dTriMesh; they must outlive the geom.
class MeshArrays
{
public:
    explicit MeshArrays(const Polyhedron &polyhedron, bool single = false);
    ~MeshArrays();
    MeshArrays(const MeshArrays &) = delete;
    MeshArrays &operator=(const MeshArrays &) = delete;

    dTriMeshDataID id() const { return id_; }
    /// ODE needs these to collide a mesh with convexes. They can be built only once.
    void build_face_angles();
    /// Gives ODE other corners in new arrays, under the same id.
    void rebuild(const Polyhedron &polyhedron);
    /// Changes corners in place, with a notice to ODE, which keeps the old box.
    void move_corners(const Eigen::Vector3d &by);

private:
    void build(const Polyhedron &polyhedron);

    dTriMeshDataID id_ = dGeomTriMeshDataCreate();
    bool single_;
    std::vector<double> vertices_;
    std::vector<float> single_vertices_;
    std::vector<dTriIndex> triangles_;
    // They are kept, so that new ones are never in the same place.
    std::vector<std::vector<double>> old_vertices_;
    std::vector<std::vector<float>> old_single_vertices_;
};
} // namespace ode_predictive_space

#endif
