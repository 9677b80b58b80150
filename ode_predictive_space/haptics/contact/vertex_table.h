// The vertices of a mesh by position.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_VERTEX_TABLE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_VERTEX_TABLE_H

#include "ode_predictive_space/haptics/device.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace ode_predictive_space::haptics
{
/// A hash table in parts, so that no call takes longer than one part takes to grow.
class VertexTable
{
public:
    /// @return the number of the vertex with exactly these coordinates. A new one is appended.
    std::uint32_t number_of(const Vector3 &place, std::vector<Vector3> &vertices)
    {
        const std::uint64_t hash = hash_of(place);
        Part &part = parts_[hash % parts_.size()];
        if (2 * part.used >= part.slots.size())
            grow(part, vertices);
        std::uint32_t &slot = slot_of(place, hash, part, vertices);
        if (slot == none)
        {
            slot = static_cast<std::uint32_t>(vertices.size());
            vertices.push_back(place);
            ++part.used;
        }
        return slot;
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    struct Part
    {
        std::vector<std::uint32_t> slots; ///< numbers of vertices, or none; the size is a power of two
        std::size_t used = 0;
    };

    /// Compares bits, so that NaN equals itself.
    static bool is_same(const Vector3 &a, const Vector3 &b)
    {
        return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
    }

    static std::uint64_t hash_of(const Vector3 &place)
    {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            std::uint64_t bits = 0;
            std::memcpy(&bits, place.data() + axis, sizeof bits);
            hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 32;
        }
        return hash;
    }

    std::uint32_t &slot_of(const Vector3 &place, std::uint64_t hash, Part &part, const std::vector<Vector3> &vertices)
    {
        std::size_t slot = hash / parts_.size() % part.slots.size();
        while (part.slots[slot] != none && !is_same(vertices[part.slots[slot]], place))
            slot = (slot + 1) % part.slots.size();
        return part.slots[slot];
    }

    void grow(Part &part, const std::vector<Vector3> &vertices)
    {
        std::vector<std::uint32_t> slots(std::max<std::size_t>(4, 2 * part.slots.size()), none);
        slots.swap(part.slots);
        for (const std::uint32_t vertex : slots)
            if (vertex != none)
                slot_of(vertices[vertex], hash_of(vertices[vertex]), part, vertices) = vertex;
    }

    std::array<Part, 256> parts_;
};
} // namespace ode_predictive_space::haptics

#endif
