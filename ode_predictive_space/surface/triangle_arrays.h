// The arrays in which a program stores a mesh. In: the number of a triangle. Out: its corners.

#ifndef ODE_PREDICTIVE_SPACE_SURFACE_TRIANGLE_ARRAYS_H
#define ODE_PREDICTIVE_SPACE_SURFACE_TRIANGLE_ARRAYS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "ode_predictive_space/surface/triangle.h"

namespace ode_predictive_space
{
/// The first members of ODE's mesh data, laid out as in ODE 0.16. The program owns the arrays.
struct TriangleArrays
{
    using Indices = std::array<std::uint32_t, 3>;

    const void *vertices; ///< 3 floats or doubles per vertex
    int vertex_stride;    ///< bytes from a vertex to the next
    unsigned vertex_count;
    const void *triangles; ///< 3 vertex indices of 32 bits per triangle
    unsigned triangle_count;
    int triangle_stride;
    bool single; ///< vertices are floats

    /// Vertex indices of a triangle, unchecked: they may be vertex_count or more.
    Indices indices(std::uint32_t triangle) const
    {
        return element<std::uint32_t>(triangles, triangle_stride, triangle);
    }

    /// @param index below vertex_count.
    Vector3 vertex(std::uint32_t index) const { return single ? vertex_of<float>(index) : vertex_of<double>(index); }

    /// @pre the vertex indices of the triangle are below vertex_count.
    TriangleCorners corners(std::uint32_t triangle) const
    {
        const auto [a, b, c] = indices(triangle);
        return {vertex(a), vertex(b), vertex(c)};
    }

private:
    // The program's arrays may be unaligned.
    template <typename T> static std::array<T, 3> element(const void *array, int stride, std::uint32_t index)
    {
        std::array<T, 3> found;
        const std::ptrdiff_t offset = std::ptrdiff_t{stride} * static_cast<std::ptrdiff_t>(index);
        std::memcpy(&found, static_cast<const char *>(array) + offset, sizeof found);
        return found;
    }

    template <typename Real> Vector3 vertex_of(std::uint32_t index) const
    {
        const std::array<Real, 3> found = element<Real>(vertices, vertex_stride, index);
        return Vector3(double{found[0]}, double{found[1]}, double{found[2]});
    }
};
} // namespace ode_predictive_space

#endif
