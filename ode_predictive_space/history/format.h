// The file of a recorded history: what a program told its spaces, and what it asked them. docs/recording.md describes it.
//
// Little-endian. A header; then records, each with the number of bytes in it. Whatever has an id gets the next one of its kind
// when it first appears.

#ifndef ODE_PREDICTIVE_SPACE_HISTORY_FORMAT_H
#define ODE_PREDICTIVE_SPACE_HISTORY_FORMAT_H

#include <cstddef>
#include <cstdint>

#include <ode/common.h>

namespace ode_predictive_space::history
{
constexpr char magic[8] = {'O', 'D', 'E', 'h', 'i', 's', 't', '\n'};
constexpr std::uint32_t format_version = 1;

/// Magic, version (4 bytes), sizeof(dReal) (4 bytes).
constexpr std::size_t header_size = sizeof magic + 8;

/// Of each record, before its content: number of bytes in the content (4 bytes), kind (1 byte).
constexpr std::size_t record_header_size = 5;

enum class RecordKind : std::uint8_t
{
    note = 1, ///< text: where the recording comes from
    mesh,     ///< id, single, vertex count, triangle count; vertices, indices
    convex,   ///< id, plane count, point count, number of polygon entries; planes, points, polygons as ODE has them
    body,     ///< id, mask of body_field; the fields that differ from before, in this order
    geom,     ///< id, class (1 byte; a class of ODE's, or stand_in), mask of geom_field; likewise
    gone,     ///< id of a geom that is in none of its spaces any more; the id is not used again
    collide,  ///< id of a space: dSpaceCollide()
    collide2, ///< ids of two geoms: dSpaceCollide2()
    pairs,    ///< number of the event (collide or collide2, from 0), number of pairs, hash of them
    end,      ///< EndReason (1 byte); nothing follows. A program that crashed leaves none.
    last = end
};

enum class EndReason : std::uint8_t
{
    closed,
    limit ///< the recording has as many bytes as it may have
};

namespace body_field
{
constexpr std::uint16_t flags = 1;    ///< 1 byte: body_enabled, body_kinematic
constexpr std::uint16_t pose = 2;     ///< 12 reals: position, rotation by rows
constexpr std::uint16_t velocity = 4; ///< 6 reals: linear, angular
constexpr std::uint16_t all = 7;
} // namespace body_field

constexpr std::uint8_t body_enabled = 1, body_kinematic = 2;

namespace geom_field
{
constexpr std::uint16_t is_new = 1;   ///< nothing; with all others, when the geom first appears
constexpr std::uint16_t space = 2;    ///< of a space: sublevel, minlevel, maxlevel (4 bytes each)
constexpr std::uint16_t parent = 4;   ///< id of a space + 1; 0: it is in none; for good
constexpr std::uint16_t bits = 8;     ///< category, collide (8 bytes each)
constexpr std::uint16_t flags = 16;   ///< 1 byte: geom_enabled and three of rays
constexpr std::uint16_t size = 32;    ///< as many reals as the class has: see size_count()
constexpr std::uint16_t data = 64;    ///< id of a mesh or convex
constexpr std::uint16_t body = 128;   ///< id of a body + 1; 0: none
constexpr std::uint16_t offset = 256; ///< has one (1 byte), 12 reals: from the body
constexpr std::uint16_t pose = 512;   ///< 12 reals, in the world; not of a geom that is where its body is
constexpr std::uint16_t all = 1023;
} // namespace geom_field

constexpr std::uint8_t geom_enabled = 1, ray_first_contact = 2, ray_backface_cull = 4, ray_closest_hit = 8;

/// The class of a geom of which only the bounding box is recorded: user classes, heightfields, transforms.
constexpr std::uint8_t stand_in = 255;

/// Reals in geom_field::size; of a stand-in, its bounding box.
int size_count(int geom_class);

bool is_space_class(int geom_class);

/// Has a position and a rotation.
bool is_placeable_class(int geom_class);

/// An order of two geoms has no meaning, and none that pairs are found in.
std::uint64_t hash_of_pair(std::uint32_t first, std::uint32_t second);

/// What a reader demands of a convex, and a recorder records: ODE compares each of its edges with all others.
constexpr std::uint32_t most_polygon_entries = 10000;

/// Vertices and triangles of a mesh that a reader takes.
constexpr std::uint32_t most_of_mesh = 100000000;

/// Spaces in spaces.
constexpr std::uint32_t deepest_nesting = 100;
} // namespace ode_predictive_space::history

#endif
