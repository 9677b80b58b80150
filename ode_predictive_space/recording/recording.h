// Reads and validates a recorded history. An accepted history can be replayed without further checks, even from a hostile file.
// A file that is cut, as when the program was killed, is accepted up to its last whole record.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_RECORDING_H
#define ODE_PREDICTIVE_SPACE_RECORDING_RECORDING_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "ode_predictive_space/recording/format.h"
#include "ode_predictive_space/recording/state.h"

namespace ode_predictive_space::recording
{
/// A file that is no recording, or one that contradicts itself.
struct BadRecording : std::runtime_error
{
    BadRecording(std::size_t offset, const std::string &what)
        : std::runtime_error("byte " + std::to_string(offset) + ": " + what), offset(offset)
    {}
    std::size_t offset; ///< of the record that is wrong, in the file
};

struct Record
{
    RecordKind kind;
    std::uint32_t size;
    std::size_t content; ///< offset of its first byte in the file
    std::size_t begin() const { return content - record_header_size; }
};

/// A change of a body: the fields of the mask count.
struct BodyChange
{
    std::uint32_t id;
    std::uint16_t fields;
    BodyState state;
};

struct GeomChange
{
    std::uint32_t id;
    std::uint16_t fields;
    GeomState state;
};

struct MeshContent
{
    bool single;
    std::uint32_t vertex_count, triangle_count;
    const char *vertices;  ///< of 3 floats or doubles each, not aligned
    const char *triangles; ///< of 3 indices (4 bytes) each, not aligned
};

struct ConvexContent
{
    std::uint32_t plane_count, point_count, entry_count;
    const char *planes, *points, *polygons; ///< not aligned
};

struct HeightsContent
{
    std::uint32_t columns, rows;
    bool repeats;
    dReal width, depth, scale, offset, thickness, lowest, highest;
    const char *samples; ///< doubles, row by row, not aligned
};

/// How often a geom was moved, or set to where it was, before an event.
struct NoticeCount
{
    std::uint32_t id, number;
};

/// A collide or a question, with what the program got for it.
struct EventSummary
{
    std::size_t record;
    bool has_pairs = false; ///< false: the program did not get to the end of it
    std::uint32_t pairs = 0;
    std::uint64_t hash = 0; ///< sum of hash_of_pair()
    bool has_times = false;
    EventTimes times = {};
};

class Recording
{
public:
    /// @throws BadRecording; std::runtime_error when the file cannot be read.
    static Recording read(const std::string &path);

    /// @throws BadRecording.
    explicit Recording(std::vector<char> bytes);

    const std::vector<Record> &records() const { return records_; }
    const std::vector<EventSummary> &events() const { return events_; }
    std::uint32_t geom_count() const { return geom_count_; }
    std::uint32_t body_count() const { return body_count_; }
    std::uint32_t stand_ins() const { return stand_ins_; }
    std::uint32_t version() const { return version_; }
    std::size_t bytes() const { return bytes_.size(); }

    /// Bytes of the header and of the whole records, where a recording that is cut ends. Less than bytes() when the last record
    /// or the header is cut.
    std::size_t whole_bytes() const;
    const std::string &note() const { return note_; }

    /// It ends as its recorder wanted. Otherwise it is cut: by the program's crash, or because its recorder had no disk or memory.
    bool has_end() const { return has_end_; }
    bool reached_limit() const { return reached_limit_; }

    /// A space that is in none. The first that is collided; the first that is asked when none is; 0 without events.
    std::uint32_t first_space() const { return first_space_; }

    /// Of all finite positions of bodies and geoms: least and greatest x, y, z. All 0 when there are none.
    const std::array<double, 6> &extent() const { return extent_; }

    // Of a record of that kind.
    BodyChange body(const Record &record) const;
    GeomChange geom(const Record &record) const;
    MeshContent mesh(const Record &record) const;
    ConvexContent convex(const Record &record) const;
    HeightsContent heights(const Record &record) const;
    std::vector<NoticeCount> notices(const Record &record) const;

    /// The first number of the content: an id.
    std::uint32_t id(const Record &record) const;

    /// Of a collide2.
    std::array<std::uint32_t, 2> asked(const Record &record) const;

private:
    class Check;

    std::vector<char> bytes_;
    std::vector<Record> records_;
    std::vector<EventSummary> events_;
    std::uint32_t geom_count_ = 0, body_count_ = 0, stand_ins_ = 0;
    std::uint32_t first_space_ = 0;
    std::uint32_t version_ = format_version;
    std::string note_;
    bool has_end_ = false, reached_limit_ = false;
    std::array<double, 6> extent_{};
};
} // namespace ode_predictive_space::recording

#endif
