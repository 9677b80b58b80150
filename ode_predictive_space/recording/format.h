// The format of a recording, little-endian: a header and records. Ids are given in order, from 0, at the first appearance.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_FORMAT_H
#define ODE_PREDICTIVE_SPACE_RECORDING_FORMAT_H

#include <cstddef>
#include <cstdint>

#include <ode/common.h>

namespace ode_predictive_space::recording
{
constexpr char magic[8] = {'O', 'D', 'E', 'h', 'i', 's', 't', '\n'};
constexpr std::uint32_t format_version = 2;

/// Version 1 has neither notices nor heights, and records a geom in a transform as a bounding box.
constexpr std::uint32_t oldest_version = 1;

/// Magic, version (4 bytes), sizeof(dReal) (4 bytes).
constexpr std::size_t header_size = sizeof magic + 8;

/// Before the content of each record: its number of bytes (4 bytes), kind (1 byte).
constexpr std::size_t record_header_size = 5;

enum class RecordKind : std::uint8_t
{
    note = 1, ///< text: the recorded program
    mesh,     ///< id, single, vertex count, triangle count; vertices, indices
    convex,   ///< id, plane count, point count, number of polygon entries; planes, points, polygons as ODE has them
    body,     ///< id, mask of body_field; the fields that differ from before, in this order
    geom,     ///< id, class (1 byte; a class of ODE's, or stand_in), mask of geom_field; as for `body`
    gone,     ///< id of a geom that has left its space; the id is not used again
    collide,  ///< id of a space: dSpaceCollide()
    collide2, ///< ids of two geoms: dSpaceCollide2()
    pairs,    ///< number of the event (collide or collide2, from 0), number of pairs, hash of them
    end,      ///< EndReason (1 byte); nothing follows. A program that crashed leaves none.
    heights, ///< id, columns, rows, repeats (1 byte); width, depth, scale, offset, thickness, lowest, highest; samples (8 bytes each)
    notices, ///< (id of a geom, number of its notices) for each geom with an unexpected number. Expected is 1 if its pose, its
        ///< body's pose or its box has changed, otherwise, and for a new geom, 0.
    times, ///< number of the event, EventTimes; only of outermost events
    last = times
};

/// Times of an event in the program, in seconds, without recording.
struct EventTimes
{
    float space;     ///< in the space, without callbacks
    float callbacks; ///< in the program's callbacks
    float tick; ///< processor time of its thread from the end of the event before to the end of this one; 0: unknown
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
constexpr std::uint16_t is_new = 1;     ///< nothing; with all others, when the geom first appears
constexpr std::uint16_t space = 2;      ///< of a space: sublevel, minlevel, maxlevel (4 bytes each)
constexpr std::uint16_t parent = 4;     ///< id of a space + 1; 0: it is in none; for good
constexpr std::uint16_t bits = 8;       ///< category, collide (8 bytes each)
constexpr std::uint16_t flags = 16;     ///< 1 byte: geom_enabled and three of rays
constexpr std::uint16_t size = 32;      ///< as many reals as the class has: see size_count()
constexpr std::uint16_t data = 64;      ///< id of a mesh, convex or heightfield
constexpr std::uint16_t body = 128;     ///< id of a body + 1; 0: none
constexpr std::uint16_t offset = 256;   ///< has one (1 byte), 12 reals: from the body
constexpr std::uint16_t pose = 512;     ///< 12 reals, in the world; not of a geom that is where its body is
constexpr std::uint16_t service = 1024; ///< of a space: SpaceService (2 bytes)

constexpr std::uint16_t all = 2047;
constexpr std::uint16_t all_of_version_1 = 1023;
} // namespace geom_field

constexpr std::uint8_t geom_enabled = 1, ray_first_contact = 2, ray_backface_cull = 4, ray_closest_hit = 8;

/// The class of a geom with only its bounding box recorded: of a user class, or with unreadable data.
constexpr std::uint8_t stand_in = 255;

constexpr std::uint8_t fixed_heightfield = 254; ///< of a heightfield that is not placeable

/// Reals in geom_field::size; of a stand-in, its bounding box.
int size_count(int geom_class);

bool is_space_class(int geom_class);

bool is_heightfield(int geom_class);

bool has_data(int geom_class);

bool is_placeable_class(int geom_class);

constexpr std::uint32_t most_notices = 1000; ///< of a geom; a reader refuses more

/// Independent of the order of the two. A sum of hashes is independent of the order of pairs.
std::uint64_t hash_of_pair(std::uint32_t first, std::uint32_t second);

/// Maximum size of a convex, as ODE compares each edge with all others. A larger one is not recorded; a reader refuses it.
constexpr std::uint32_t most_polygon_entries = 10000;

/// Maximum number of vertices or triangles of a mesh, or of samples of a heightfield; a reader refuses more.
constexpr std::uint32_t most_of_mesh = 100000000;

constexpr std::uint32_t deepest_nesting = 100;
} // namespace ode_predictive_space::recording

#endif
