// An accepted recording can be replayed without further checks, even from a hostile file. One that is cut, as when the program
// was killed, is accepted up to its last whole record.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_RECORDING_H
#define ODE_PREDICTIVE_SPACE_RECORDING_RECORDING_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "ode_predictive_space/recording/format.h"
#include "ode_predictive_space/recording/state.h"

namespace ode_predictive_space::recording
{
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

/// The fields of the mask count.
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
    bool single = false;
    std::vector<char> vertices;           ///< of 3 floats or doubles each
    std::vector<std::uint32_t> triangles; ///< 3 indices each
};

struct ConvexContent
{
    std::vector<dReal> planes, points;
    std::vector<std::uint32_t> polygons;
};

struct HeightsContent
{
    std::uint32_t columns = 0, rows = 0;
    bool repeats = false;
    dReal width = 0, depth = 0, scale = 0, offset = 0, thickness = 0, lowest = 0, highest = 0;
    std::vector<double> samples; ///< row by row
};

using DataContent = std::variant<MeshContent, ConvexContent, HeightsContent>;

/// The number of notices for a geom before an event: how often its pose was set, also to the same pose.
struct NoticeCount
{
    std::uint32_t id, number;
};

struct EventSummary
{
    std::size_t record;
    bool has_pairs = false; ///< the program got to its end
    std::uint32_t pairs = 0;
    std::uint64_t hash = 0; ///< sum of hash_of_pair()
    bool has_times = false;
    EventTimes times = {};
};

class Recording
{
public:
    /// @throws BadRecording, as the constructor does; std::runtime_error when the file cannot be read.
    static Recording read(const std::string &path);

    explicit Recording(std::vector<char> bytes);

    const std::vector<Record> &records() const { return records_; }
    const std::vector<EventSummary> &events() const { return events_; }
    std::uint32_t geom_count() const { return geom_count_; }
    std::uint32_t body_count() const { return body_count_; }
    std::uint32_t stand_ins() const { return stand_ins_; }
    std::uint32_t version() const { return version_; }
    std::size_t bytes() const { return bytes_.size(); }

    /// Bytes of the header and of the whole records: less than bytes() when the recording is cut.
    std::size_t whole_bytes() const;
    const std::string &note() const { return note_; }

    /// False for a recording that is cut: by the program's crash, or for lack of disk or memory.
    bool has_end() const { return has_end_; }
    bool reached_limit() const { return reached_limit_; }

    /// The id of the space that is collided first; of the one that is asked first when none is collided; 0 without events.
    std::uint32_t first_space() const { return first_space_; }

    /// Its state when it was new; that of a hash space of ODE without events.
    GeomState state_of_first_space() const;

    /// Least and greatest x, y and z of all finite positions of bodies and geoms. All 0 when there are none.
    const std::array<double, 6> &extent() const { return extent_; }

    // The content of a record of this kind.
    BodyChange body(const Record &record) const;
    GeomChange geom(const Record &record) const;
    std::vector<NoticeCount> notices(const Record &record) const;

    const DataContent &data(std::uint32_t id) const { return data_[id]; }

    std::uint32_t id(const Record &record) const;

    std::array<std::uint32_t, 2> asked(const Record &record) const;

private:
    class Check;

    std::vector<char> bytes_;
    std::vector<Record> records_;
    std::vector<EventSummary> events_;
    std::deque<DataContent> data_;
    std::uint32_t geom_count_ = 0, body_count_ = 0, stand_ins_ = 0;
    std::uint32_t first_space_ = 0;
    std::uint32_t version_ = format_version;
    std::string note_;
    bool has_end_ = false, reached_limit_ = false;
    std::array<double, 6> extent_{};
};
} // namespace ode_predictive_space::recording

#endif
