// The arrays that a program keeps its mesh in. In: the number of a triangle. Out: its corners.

#ifndef ODE_PREDICTIVE_SPACE_SURFACE_TRIANGLE_ARRAYS_H
#define ODE_PREDICTIVE_SPACE_SURFACE_TRIANGLE_ARRAYS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "ode_predictive_space/surface/triangle.h"

namespace ode_predictive_space
{
/// The first members of ODE's data of a mesh, in ODE 0.16. The arrays are the program's own.
struct TriangleArrays
{
    using Indices = std::array<std::uint32_t, 3>;

    const void *vertices; ///< of 3 floats or doubles each
    int vertex_stride;    ///< bytes from one to the next
    unsigned vertex_count;
    const void *triangles; ///< of 3 indices of vertices each, of 32 bits
    unsigned triangle_count;
    int triangle_stride;
    bool single; ///< vertices of floats

    /// The vertices of a triangle. Those may not exist: see vertex_count.
    Indices indices(std::uint32_t triangle) const
    {
        return element<std::uint32_t>(triangles, triangle_stride, triangle);
    }

    /// @param index below vertex_count.
    Vector3 vertex(std::uint32_t index) const { return single ? vertex_of<float>(index) : vertex_of<double>(index); }

    /// Of a triangle whose vertices exist.
    TriangleCorners corners(std::uint32_t triangle) const
    {
        const auto [a, b, c] = indices(triangle);
        return {vertex(a), vertex(b), vertex(c)};
    }

private:
    // Arrays of programs may begin at any byte.
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
