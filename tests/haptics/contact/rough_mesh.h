// Meshes as rough as scans: waves of many lengths, and a scanner's noise on each vertex.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_ROUGH_MESH_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_ROUGH_MESH_H

#include "tests/haptics/support/mesh_maker.h"
#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
/// A closed ball of some 4 n^2 triangles about the origin, with ridges and hollows of all sizes.
/// @param mean m; mean radius. @param rings n, between the poles. @param roughness of the radius. @param noise m; of vertices.
inline MeshShape rough_ball(double mean, int rings, double roughness, double noise, unsigned seed)
{
    RandomNumbers random(seed);
    MeshShape shape = sphere_mesh(mean, 2 * rings);
    std::vector<double> heights(shape.vertices.size(), 0);
    for (double waves = 3, high = roughness; waves < rings / 4.0; waves *= 1.5, high *= 0.7)
    {
        const Vector3 along = waves / mean * random.direction();
        const double phase = random.between(0, 2 * M_PI);
        for (std::size_t i = 0; i < heights.size(); ++i)
            heights[i] += high * std::sin(along.dot(shape.vertices[i]) + phase);
    }
    for (std::size_t i = 0; i < heights.size(); ++i)
        shape.vertices[i] += heights[i] * shape.vertices[i] + random.in_cube(noise);
    return shape;
}
} // namespace ode_predictive_space::haptics

#endif
