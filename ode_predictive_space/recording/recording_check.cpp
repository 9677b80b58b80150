// Validates a recording: reads the records in their order, and keeps track of all objects as a replay does.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include <ode/collision.h>

#include "ode_predictive_space/predictive_space.h"
#include "ode_predictive_space/recording/record_cursor.h"
#include "ode_predictive_space/recording/recording.h"

namespace ode_predictive_space::recording
{
class Recording::Check
{
public:
    explicit Check(Recording &recording) : recording_(recording) {}

    // @return whether it is whole.
    bool take_header();
    void take_records();

private:
    struct Geom
    {
        int geom_class;
        bool gone = false;
        bool has_body = false;
        std::uint32_t depth = 0; // of the spaces around it
    };

    bool next_record(Record &record) const;
    void take(const Record &record);
    RecordCursor cursor_of_data(const Record &record) const;
    void take_mesh(const Record &record);
    void take_convex(const Record &record);
    void take_heights(const Record &record);
    void take_notices(const Record &record);
    void take_times(const Record &record);
    void take_body(const Record &record);
    void take_geom(const Record &record);
    std::uint32_t depth_in(const RecordCursor &cursor, std::uint32_t parent) const;
    void check_data(const RecordCursor &cursor, const GeomState &state) const;
    void check_version(const RecordCursor &cursor, const GeomChange &change) const;
    void add_geom(const RecordCursor &cursor, const GeomChange &change);
    void take_body_of(const RecordCursor &cursor, Geom &geom, const GeomChange &change) const;
    void take_gone(const Record &record);
    void take_event(const Record &record);
    void take_pairs(const Record &record);
    void take_end(const Record &record);
    std::uint32_t take_live(RecordCursor &cursor) const;
    void extend(const Pose &pose);

    Recording &recording_;
    std::vector<Geom> geoms_;
    bool has_collide_ = false, has_query_ = false;
};

Recording::Recording(std::vector<char> bytes) : bytes_(std::move(bytes))
{
    Check check(*this);
    if (check.take_header())
        check.take_records();
}

bool Recording::Check::take_header()
{
    const std::vector<char> &bytes = recording_.bytes_;
    if (!std::equal(bytes.begin(), bytes.begin() + std::min(bytes.size(), sizeof magic), magic))
        throw BadRecording(0, "this is not a recording of ODE's spaces");
    if (bytes.size() < header_size)
        return false;
    std::uint32_t &version = recording_.version_;
    std::uint32_t size_of_real;
    std::memcpy(&version, bytes.data() + sizeof magic, sizeof version);
    std::memcpy(&size_of_real, bytes.data() + sizeof magic + sizeof version, sizeof size_of_real);
    if (version < oldest_version || version > format_version)
        throw BadRecording(sizeof magic, "the format has version " + std::to_string(version) +
                                             "; this tool reads versions " + std::to_string(oldest_version) + " to " +
                                             std::to_string(format_version));
    if (size_of_real != sizeof(dReal))
        throw BadRecording(sizeof magic + 4,
                           size_of_real == 4   ? "recorded in single precision; the ODE of this tool has double"
                           : size_of_real == 8 ? "recorded in double precision; the ODE of this tool has single"
                                               : "the precision is unknown");
    return true;
}

void Recording::Check::take_records()
{
    for (Record record{}; next_record(record); recording_.records_.push_back(record))
        take(record);
    if (recording_.has_end_ && recording_.whole_bytes() < recording_.bytes_.size())
        throw BadRecording(recording_.whole_bytes(), "a record follows the end");
}

namespace
{
// Only notes, notices and the data of geoms are longer. No recorder has written another larger record, even in a cut recording.
constexpr std::uint32_t most_of_other_kinds = 1000;

bool can_be_cut(const Record &record)
{
    switch (record.kind)
    {
    case RecordKind::note:
    case RecordKind::mesh:
    case RecordKind::convex:
    case RecordKind::heights:
    case RecordKind::notices:
        return true;
    default:
        return record.kind <= RecordKind::last && record.size <= most_of_other_kinds;
    }
}
} // namespace

// @return whether there is a further whole record. A program that was killed may leave the beginning of one.
bool Recording::Check::next_record(Record &record) const
{
    const std::vector<char> &bytes = recording_.bytes_;
    const std::size_t at = recording_.whole_bytes();
    if (recording_.has_end_ || bytes.size() - at < record_header_size)
        return false;
    std::memcpy(&record.size, bytes.data() + at, sizeof record.size);
    record.kind = static_cast<RecordKind>(bytes[at + sizeof record.size]);
    record.content = at + record_header_size;
    if (record.size <= bytes.size() - record.content)
        return true;
    if (!can_be_cut(record))
        throw BadRecording(at, "the record is longer than any of its kind");
    return false;
}

void Recording::Check::take(const Record &record)
{
    switch (record.kind)
    {
    case RecordKind::note:
        recording_.note_.assign(recording_.bytes_.data() + record.content, record.size);
        return;
    case RecordKind::mesh:
        return take_mesh(record);
    case RecordKind::convex:
        return take_convex(record);
    case RecordKind::body:
        return take_body(record);
    case RecordKind::geom:
        return take_geom(record);
    case RecordKind::gone:
        return take_gone(record);
    case RecordKind::collide:
    case RecordKind::collide2:
        return take_event(record);
    case RecordKind::pairs:
        return take_pairs(record);
    case RecordKind::end:
        return take_end(record);
    case RecordKind::heights:
        return take_heights(record);
    case RecordKind::notices:
        return take_notices(record);
    case RecordKind::times:
        return take_times(record);
    }
    throw BadRecording(record.begin(), "the kind of the record is unknown");
}

RecordCursor Recording::Check::cursor_of_data(const Record &record) const
{
    RecordCursor cursor(recording_.bytes_, record);
    if (cursor.take<std::uint32_t>() != recording_.data_.size())
        cursor.refuse("the id is not the next one");
    return cursor;
}

namespace
{
template <typename Real> bool all_finite(const std::vector<char> &values)
{
    for (std::size_t at = 0; at < values.size(); at += sizeof(Real))
    {
        Real value;
        std::memcpy(&value, &values[at], sizeof value);
        if (!std::isfinite(value))
            return false;
    }
    return true;
}
} // namespace

void Recording::Check::take_mesh(const Record &record)
{
    RecordCursor cursor = cursor_of_data(record);
    const auto precision = cursor.take<std::uint8_t>();
    const auto vertices = cursor.take<std::uint32_t>(), triangles = cursor.take<std::uint32_t>();
    if (precision > 1)
        cursor.refuse("the precision of a mesh's vertices is unknown");
    MeshContent mesh;
    mesh.single = precision == 1;
    cursor.take_all(mesh.vertices, std::uint64_t{3} * vertices * (mesh.single ? sizeof(float) : sizeof(double)));
    cursor.take_all(mesh.triangles, std::uint64_t{3} * triangles);
    cursor.expect_end();
    if (triangles == 0 || triangles > most_of_mesh || vertices > most_of_mesh)
        cursor.refuse("a mesh has no triangle, or too many");
    if (!(mesh.single ? all_finite<float>(mesh.vertices) : all_finite<double>(mesh.vertices)))
        cursor.refuse("a vertex is not finite");
    if (*std::max_element(mesh.triangles.begin(), mesh.triangles.end()) >= vertices)
        cursor.refuse("a triangle has a corner that is not a vertex");
    recording_.data_.emplace_back(std::move(mesh));
}

void Recording::Check::take_convex(const Record &record)
{
    RecordCursor cursor = cursor_of_data(record);
    const auto planes = cursor.take<std::uint32_t>(), points = cursor.take<std::uint32_t>(),
               entries = cursor.take<std::uint32_t>();
    ConvexContent convex;
    cursor.take_all(convex.planes, std::uint64_t{4} * planes);
    cursor.take_all(convex.points, std::uint64_t{3} * points);
    cursor.take_all(convex.polygons, entries);
    cursor.expect_end();
    if (points == 0 || planes == 0 || entries > most_polygon_entries || points > most_polygon_entries)
        cursor.refuse("a convex has no point, no plane, or too many");
    std::uint32_t at = 0;
    for (std::uint32_t plane = 0; plane < planes; ++plane)
    {
        const std::uint32_t corners = at < entries ? convex.polygons[at] : 0;
        if (corners < 3 || corners >= entries - at)
            cursor.refuse("a polygon has too few or too many corners");
        for (std::uint32_t corner = 1; corner <= corners; ++corner)
            if (convex.polygons[at + corner] >= points)
                cursor.refuse("a polygon has a corner that is not a point");
        at += corners + 1;
    }
    if (at != entries)
        cursor.refuse("there are more polygons than planes");
    recording_.data_.emplace_back(std::move(convex));
}

void Recording::Check::take_heights(const Record &record)
{
    RecordCursor cursor = cursor_of_data(record);
    HeightsContent field;
    cursor.take(field.columns);
    cursor.take(field.rows);
    if (field.columns < 2 || field.rows < 2 || field.columns > most_of_mesh ||
        field.rows > most_of_mesh / field.columns)
        cursor.refuse("a heightfield has too few or too many samples");
    const auto repeats = cursor.take<std::uint8_t>();
    if (repeats > 1)
        cursor.refuse("a heightfield neither repeats nor ends");
    field.repeats = repeats == 1;
    for (dReal *number : {&field.width, &field.depth, &field.scale, &field.offset, &field.thickness})
        if (cursor.take(*number); !std::isfinite(*number))
            cursor.refuse("a number of a heightfield is not finite");
    cursor.take(field.lowest);
    cursor.take(field.highest);
    cursor.take_all(field.samples, std::uint64_t{field.columns} * field.rows);
    cursor.expect_end();
    if (!(field.width > 0) || !(field.depth > 0))
        cursor.refuse("a heightfield has no width or no depth");
    if (std::isnan(field.lowest) || std::isnan(field.highest))
        cursor.refuse("a bound of a heightfield is not a number");
    if (!std::all_of(field.samples.begin(), field.samples.end(), [](double sample) { return std::isfinite(sample); }))
        cursor.refuse("a sample is not finite");
    recording_.data_.emplace_back(std::move(field));
}

void Recording::Check::take_notices(const Record &record)
{
    const RecordCursor cursor(recording_.bytes_, record);
    for (const NoticeCount &count : recording_.notices(record))
    {
        if (count.id >= geoms_.size() || geoms_[count.id].gone)
            cursor.refuse("a geom that does not exist has notices");
        if (count.number > most_notices)
            cursor.refuse("a geom has too many notices");
    }
}

void Recording::Check::extend(const Pose &pose)
{
    constexpr double most = 1e9; // objects farther away are ignored
    std::array<double, 6> &extent = recording_.extent_;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (const double value = pose[axis]; std::abs(value) < most)
        {
            extent[2 * axis] = std::min(extent[2 * axis], value);
            extent[2 * axis + 1] = std::max(extent[2 * axis + 1], value);
        }
}

void Recording::Check::take_body(const Record &record)
{
    const RecordCursor cursor(recording_.bytes_, record);
    const BodyChange change = recording_.body(record);
    if (change.id > recording_.body_count_)
        cursor.refuse("the id of a body is not the next one");
    if (change.id == recording_.body_count_)
    {
        if (change.fields != body_field::all)
            cursor.refuse("a new body is not described");
        ++recording_.body_count_;
    }
    if (change.fields & body_field::pose)
        extend(change.state.pose);
}

namespace
{
// Refuses sizes that end ODE by an assertion.
void check_size(const RecordCursor &cursor, const GeomState &state)
{
    const int geom_class = state.geom_class;
    if (geom_class == dPlaneClass || geom_class == dRayClass || geom_class == stand_in)
        return;
    for (int i = 0; i < size_count(geom_class); ++i)
        if (!(state.size[static_cast<std::size_t>(i)] >= 0))
            cursor.refuse("a size is negative or not a number");
}

void check_levels(const RecordCursor &cursor, const SpaceState &state)
{
    constexpr std::int32_t most = 1100; // as a logarithm of a number
    if (state.min_level < -most || state.min_level > state.max_level || state.max_level > most)
        cursor.refuse("a hash space has impossible levels");
}

void check_service(const RecordCursor &cursor, const SpaceService &service)
{
    if (service.predictive > 1 + dPredictiveProximityShape || service.is_substitute > (service.predictive != 0))
        cursor.refuse("the kind of a predictive space is unknown");
}
} // namespace

void Recording::Check::check_version(const RecordCursor &cursor, const GeomChange &change) const
{
    if (recording_.version_ == 1 && ((change.fields & geom_field::service) || is_heightfield(change.state.geom_class)))
        cursor.refuse("a file of version 1 cannot have such a geom");
}

std::uint32_t Recording::Check::depth_in(const RecordCursor &cursor, std::uint32_t parent) const
{
    if (parent == 0)
        return 0;
    if (parent > geoms_.size() || !is_space_class(geoms_[parent - 1].geom_class) || geoms_[parent - 1].gone)
        cursor.refuse("a geom is in a geom that is not a space, or that is gone");
    const std::uint32_t depth = geoms_[parent - 1].depth + 1;
    if (depth > deepest_nesting)
        cursor.refuse("spaces are nested too deeply");
    return depth;
}

void Recording::Check::take_geom(const Record &record)
{
    const RecordCursor cursor(recording_.bytes_, record);
    const std::uint32_t id = recording_.id(record);
    if (id > geoms_.size())
        cursor.refuse("the id of a geom is not the next one");
    const bool is_new = id == geoms_.size();
    const GeomChange change = recording_.geom(record);
    check_version(cursor, change);
    if (is_new)
        add_geom(cursor, change);
    Geom &geom = geoms_[id];
    if (geom.gone)
        cursor.refuse("the geom is gone");
    if (geom.geom_class != change.state.geom_class || is_new != bool(change.fields & geom_field::is_new))
        cursor.refuse("the geom has another class than before");
    if ((change.fields & geom_field::parent) && !is_new)
        cursor.refuse("a geom has moved to another space");
    if (change.fields & geom_field::size)
        check_size(cursor, change.state);
    if ((change.fields & geom_field::space) && geom.geom_class == dHashSpaceClass)
        check_levels(cursor, change.state.space);
    if (change.fields & geom_field::service)
        check_service(cursor, change.state.service);
    if (change.fields & geom_field::data)
        check_data(cursor, change.state);
    take_body_of(cursor, geom, change);
    if (change.fields & geom_field::pose && is_placeable_class(geom.geom_class))
        extend(change.state.pose);
}

void Recording::Check::add_geom(const RecordCursor &cursor, const GeomChange &change)
{
    if (change.fields != (recording_.version_ == 1 ? geom_field::all_of_version_1 : geom_field::all))
        cursor.refuse("a new geom is not described");
    const int geom_class = change.state.geom_class;
    geoms_.push_back({geom_class, false, false, depth_in(cursor, change.state.parent)});
    recording_.stand_ins_ += geom_class == stand_in;
    recording_.geom_count_ = static_cast<std::uint32_t>(geoms_.size());
}

void Recording::Check::check_data(const RecordCursor &cursor, const GeomState &state) const
{
    if (!has_data(state.geom_class))
        return;
    const std::deque<DataContent> &data = recording_.data_;
    const bool has_them =
        state.data < data.size() &&
        (state.geom_class == dTriMeshClass  ? std::holds_alternative<MeshContent>(data[state.data])
         : state.geom_class == dConvexClass ? std::holds_alternative<ConvexContent>(data[state.data])
                                            : std::holds_alternative<HeightsContent>(data[state.data]));
    if (!has_them)
        cursor.refuse("the data of a mesh, convex or heightfield do not exist");
}

void Recording::Check::take_body_of(const RecordCursor &cursor, Geom &geom, const GeomChange &change) const
{
    const GeomState &state = change.state;
    if (change.fields & geom_field::body)
    {
        const bool may_have = is_placeable_class(geom.geom_class) || geom.geom_class == stand_in;
        if (state.body > recording_.body_count_ || (state.body != 0 && !may_have))
            cursor.refuse("a body does not exist");
        geom.has_body = state.body != 0;
    }
    if ((change.fields & geom_field::offset) && state.has_offset &&
        (!geom.has_body || !is_placeable_class(geom.geom_class)))
        cursor.refuse("a geom without a body has an offset");
}

std::uint32_t Recording::Check::take_live(RecordCursor &cursor) const
{
    const auto id = cursor.take<std::uint32_t>();
    if (id >= geoms_.size() || geoms_[id].gone)
        cursor.refuse("a geom does not exist");
    return id;
}

void Recording::Check::take_gone(const Record &record)
{
    RecordCursor cursor(recording_.bytes_, record);
    geoms_[take_live(cursor)].gone = true;
    cursor.expect_end();
}

void Recording::Check::take_event(const Record &record)
{
    RecordCursor cursor(recording_.bytes_, record);
    const bool is_collide = record.kind == RecordKind::collide;
    const std::uint32_t first = take_live(cursor);
    const std::uint32_t second = is_collide ? first : take_live(cursor);
    cursor.expect_end();
    const bool first_is_space = is_space_class(geoms_[first].geom_class);
    if (!first_is_space && !is_space_class(geoms_[second].geom_class))
        cursor.refuse("the geom that is queried is not a space");
    if (is_collide ? !has_collide_ : !has_collide_ && !has_query_)
        recording_.first_space_ = first_is_space ? first : second;
    has_collide_ |= is_collide;
    has_query_ = true;
    recording_.events_.push_back({recording_.records_.size()});
}

void Recording::Check::take_pairs(const Record &record)
{
    RecordCursor cursor(recording_.bytes_, record);
    const auto number = cursor.take<std::uint32_t>();
    if (number >= recording_.events_.size() || recording_.events_[number].has_pairs)
        cursor.refuse("the event of these pairs does not exist, or has pairs");
    EventSummary &event = recording_.events_[number];
    event.has_pairs = true;
    cursor.take(event.pairs);
    cursor.take(event.hash);
    cursor.expect_end();
}

void Recording::Check::take_times(const Record &record)
{
    RecordCursor cursor(recording_.bytes_, record);
    const auto number = cursor.take<std::uint32_t>();
    if (number >= recording_.events_.size() || recording_.events_[number].has_times)
        cursor.refuse("the event of these times does not exist, or has times");
    EventSummary &event = recording_.events_[number];
    event.has_times = true;
    cursor.take(event.times);
    cursor.expect_end();
    for (const float seconds : {event.times.space, event.times.callbacks, event.times.tick})
        if (!(seconds >= 0) || std::isinf(seconds))
            cursor.refuse("a time is negative or not finite");
}

void Recording::Check::take_end(const Record &record)
{
    RecordCursor cursor(recording_.bytes_, record);
    const auto reason = cursor.take<std::uint8_t>();
    if (reason > static_cast<std::uint8_t>(EndReason::limit))
        cursor.refuse("the reason of the end is unknown");
    cursor.expect_end();
    recording_.has_end_ = true;
    recording_.reached_limit_ = reason == static_cast<std::uint8_t>(EndReason::limit);
}
} // namespace ode_predictive_space::recording
