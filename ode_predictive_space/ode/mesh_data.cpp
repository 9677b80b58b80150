#include "ode_predictive_space/ode/mesh_data.h"

#include <array>

namespace ode_predictive_space
{
namespace
{
const TriangleArrays *laid_out(dTriMeshDataID data)
{
    return reinterpret_cast<const TriangleArrays *>(data);
}

// Builds mesh data with a distinct value in every member.
template <typename Real, typename Build> bool is_laid_out_as_expected(Build build)
{
    constexpr int vertices = 5, vertex_stride = 4 * sizeof(Real), triangles = 2,
                  triangle_stride = 4 * sizeof(dTriIndex);
    std::array<Real, 4 * vertices> coordinates{};
    for (std::size_t i = 0; i < coordinates.size(); ++i)
        coordinates[i] = static_cast<Real>(i * i);
    const std::array<dTriIndex, 4 * triangles> indices{0, 1, 2, 0, 2, 3, 4, 0};
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    build(data, coordinates.data(), vertex_stride, vertices, indices.data(), 3 * triangles, triangle_stride);
    const TriangleArrays &found = *laid_out(data);
    const bool as_expected = found.vertices == coordinates.data() && found.vertex_stride == vertex_stride &&
                             found.vertex_count == vertices && found.triangles == indices.data() &&
                             found.triangle_count == triangles && found.triangle_stride == triangle_stride &&
                             found.single == (sizeof(Real) == sizeof(float));
    dGeomTriMeshDataDestroy(data);
    return as_expected;
}
} // namespace

const TriangleArrays *mesh_data_of(dGeomID mesh)
{
    static_assert(sizeof(dTriIndex) == 4, "as ODE is configured by default");
    static const bool known = is_laid_out_as_expected<float>(dGeomTriMeshDataBuildSingle) &&
                              is_laid_out_as_expected<double>(dGeomTriMeshDataBuildDouble);
    return known ? laid_out(dGeomTriMeshGetData(mesh)) : nullptr;
}
} // namespace ode_predictive_space
