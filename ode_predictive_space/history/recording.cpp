#include "ode_predictive_space/history/recording.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <type_traits>
#include <utility>

#include <ode/collision.h>

namespace ode_predictive_space::history
{
// Takes values from a record one after another; never more than it has.
class Recording::Cursor
{
public:
    Cursor(const std::vector<char> &bytes, const Record &record)
        : next_(bytes.data() + record.content), left_(record.size), begin_(record.begin())
    {}

    [[noreturn]] void refuse(const std::string &what) const { throw BadRecording(begin_, what); }

    template <typename Value> void take(Value &value)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::memcpy(&value, take_bytes(sizeof value), sizeof value);
    }

    template <typename Value> Value take()
    {
        Value value;
        take(value);
        return value;
    }

    void take_reals(dReal *values, int count)
    {
        const std::size_t size = sizeof(dReal) * static_cast<std::size_t>(count);
        std::memcpy(values, take_bytes(size), size);
    }

    const char *take_bytes(std::uint64_t size)
    {
        if (size > left_)
            refuse("the record is shorter than what it has to hold");
        left_ -= static_cast<std::size_t>(size);
        return std::exchange(next_, next_ + size);
    }

    void expect_end() const
    {
        if (left_ != 0)
            refuse("the record is longer than what it has to hold");
    }

private:
    const char *next_;
    std::size_t left_;
    std::size_t begin_;
};

// Goes through the records in their order and knows, as a replay would, what there is.
class Recording::Check
{
public:
    explicit Check(Recording &recording) : recording_(recording) {}

    void take_header();
    void take_records();

private:
    struct Geom
    {
        int geom_class;
        bool gone = false;
        bool has_body = false;
        std::uint32_t depth = 0; // of the spaces around it
    };
    enum class Shape : std::uint8_t
    {
        mesh,
        convex
    };

    void take(const Record &record);
    void take_mesh(const Record &record);
    void take_convex(const Record &record);
    void take_body(const Record &record);
    void take_geom(const Record &record);
    std::uint32_t depth_in(const Cursor &cursor, std::uint32_t parent) const;
    static void check_levels(const Cursor &cursor, const SpaceState &state);
    static void check_size(const Cursor &cursor, const GeomState &state);
    void take_gone(const Record &record);
    void take_event(const Record &record);
    void take_pairs(const Record &record);
    void take_end(const Record &record);
    void take_data_id(Cursor &cursor, Shape shape);
    std::uint32_t take_live(Cursor &cursor) const;
    void extend(const Pose &pose);

    Recording &recording_;
    std::vector<Geom> geoms_;
    std::vector<Shape> data_;
    bool has_collide_ = false, has_question_ = false;
};

namespace
{
bool is_within(std::uint16_t fields, std::uint16_t all)
{
    return fields != 0 && (fields & ~all) == 0;
}
} // namespace

Recording Recording::read(const std::string &path)
{
    std::error_code none;
    if (std::filesystem::is_directory(path, none))
        throw std::runtime_error("it is a folder");
    errno = 0;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0)
        throw std::runtime_error("cannot be read: " + std::string(std::strerror(errno ? errno : EIO)));
    std::vector<char> bytes(static_cast<std::size_t>(size));
    file.seekg(0);
    if (!file.read(bytes.data(), size))
        throw std::runtime_error("cannot be read: " + std::string(std::strerror(errno ? errno : EIO)));
    return Recording(std::move(bytes));
}

Recording::Recording(std::vector<char> bytes) : bytes_(std::move(bytes))
{
    Check check(*this);
    check.take_header();
    check.take_records();
}

void Recording::Check::take_header()
{
    const std::vector<char> &bytes = recording_.bytes_;
    if (bytes.size() < header_size || std::memcmp(bytes.data(), magic, sizeof magic) != 0)
        throw BadRecording(0, "this is no recorded history of ODE");
    std::uint32_t version, size_of_real;
    std::memcpy(&version, bytes.data() + sizeof magic, sizeof version);
    std::memcpy(&size_of_real, bytes.data() + sizeof magic + sizeof version, sizeof size_of_real);
    if (version != format_version)
        throw BadRecording(sizeof magic, "the format has version " + std::to_string(version) + "; version " +
                                             std::to_string(format_version) + " is read here");
    if (size_of_real != sizeof(dReal))
        throw BadRecording(sizeof magic + 4, size_of_real == 4   ? "recorded in single precision; this ODE has double"
                                             : size_of_real == 8 ? "recorded in double precision; this ODE has single"
                                                                 : "there is no such precision");
}

void Recording::Check::take_records()
{
    const std::vector<char> &bytes = recording_.bytes_;
    for (std::size_t at = header_size; at < bytes.size();)
    {
        if (recording_.has_end_)
            throw BadRecording(at, "something follows the end");
        if (bytes.size() - at < record_header_size)
            throw BadRecording(at, "the file ends within a record");
        Record record{};
        std::memcpy(&record.size, bytes.data() + at, sizeof record.size);
        record.kind = static_cast<RecordKind>(bytes[at + sizeof record.size]);
        record.content = at + record_header_size;
        if (record.size > bytes.size() - record.content)
            throw BadRecording(at, "the file ends within a record");
        take(record);
        recording_.records_.push_back(record);
        at = record.content + record.size;
    }
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
    }
    throw BadRecording(record.begin(), "there is no such kind of record");
}

void Recording::Check::take_data_id(Cursor &cursor, Shape shape)
{
    if (cursor.take<std::uint32_t>() != data_.size())
        cursor.refuse("the id is not the next one");
    data_.push_back(shape);
}

namespace
{
template <typename Real> bool all_finite(const char *values, std::uint64_t count)
{
    for (std::uint64_t i = 0; i < count; ++i)
    {
        Real value;
        std::memcpy(&value, values + i * sizeof value, sizeof value);
        if (!std::isfinite(value))
            return false;
    }
    return true;
}

std::uint32_t number_at(const char *numbers, std::uint64_t index)
{
    std::uint32_t number;
    std::memcpy(&number, numbers + index * sizeof number, sizeof number);
    return number;
}
} // namespace

void Recording::Check::take_mesh(const Record &record)
{
    Cursor cursor(recording_.bytes_, record);
    take_data_id(cursor, Shape::mesh);
    if (cursor.take<std::uint8_t>() > 1)
        cursor.refuse("a mesh has vertices of no known precision");
    const MeshContent mesh = recording_.mesh(record); // not before the byte of the precision is known
    if (mesh.triangle_count == 0 || mesh.triangle_count > most_of_mesh || mesh.vertex_count > most_of_mesh)
        cursor.refuse("a mesh has no triangle, or too many");
    const std::uint64_t reals = std::uint64_t{3} * mesh.vertex_count;
    if (!(mesh.single ? all_finite<float>(mesh.vertices, reals) : all_finite<double>(mesh.vertices, reals)))
        cursor.refuse("a vertex is not finite");
    for (std::uint64_t i = 0; i < std::uint64_t{3} * mesh.triangle_count; ++i)
        if (number_at(mesh.triangles, i) >= mesh.vertex_count)
            cursor.refuse("a triangle has a corner that is no vertex");
}

void Recording::Check::take_convex(const Record &record)
{
    Cursor cursor(recording_.bytes_, record);
    take_data_id(cursor, Shape::convex);
    const ConvexContent convex = recording_.convex(record);
    if (convex.point_count == 0 || convex.plane_count == 0 || convex.entry_count > most_polygon_entries ||
        convex.point_count > most_polygon_entries)
        cursor.refuse("a convex has no point, no plane, or too many");
    std::uint32_t at = 0;
    for (std::uint32_t plane = 0; plane < convex.plane_count; ++plane)
    {
        const std::uint32_t corners = at < convex.entry_count ? number_at(convex.polygons, at) : 0;
        if (corners < 3 || corners >= convex.entry_count - at)
            cursor.refuse("a polygon has too few or too many corners");
        for (std::uint32_t corner = 1; corner <= corners; ++corner)
            if (number_at(convex.polygons, at + corner) >= convex.point_count)
                cursor.refuse("a polygon has a corner that is no point");
        at += corners + 1;
    }
    if (at != convex.entry_count)
        cursor.refuse("there are more polygons than planes");
}

void Recording::Check::extend(const Pose &pose)
{
    constexpr double most = 1e9; // an object that was lost is no part of the scene
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
    const Cursor cursor(recording_.bytes_, record);
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

// Not what ODE would stop at.
void Recording::Check::check_size(const Cursor &cursor, const GeomState &state)
{
    const int geom_class = state.geom_class;
    if (geom_class == dPlaneClass || geom_class == dRayClass || geom_class == stand_in)
        return;
    for (int i = 0; i < size_count(geom_class); ++i)
        if (!(state.size[static_cast<std::size_t>(i)] >= 0))
            cursor.refuse("a size is negative or not a number");
}

void Recording::Check::check_levels(const Cursor &cursor, const SpaceState &state)
{
    constexpr std::int32_t most = 1100; // as a logarithm of a number
    if (state.min_level < -most || state.min_level > state.max_level || state.max_level > most)
        cursor.refuse("a hash space has no such levels");
}

std::uint32_t Recording::Check::depth_in(const Cursor &cursor, std::uint32_t parent) const
{
    if (parent == 0)
        return 0;
    if (parent > geoms_.size() || !is_space_class(geoms_[parent - 1].geom_class) || geoms_[parent - 1].gone)
        cursor.refuse("a geom is in something that is no space, or is gone");
    const std::uint32_t depth = geoms_[parent - 1].depth + 1;
    if (depth > deepest_nesting)
        cursor.refuse("spaces are nested too deeply");
    return depth;
}

void Recording::Check::take_geom(const Record &record)
{
    const Cursor cursor(recording_.bytes_, record);
    const std::uint32_t id = recording_.id(record);
    if (id > geoms_.size())
        cursor.refuse("the id of a geom is not the next one");
    const bool is_new = id == geoms_.size();
    const GeomChange change = recording_.geom(record);
    const GeomState &state = change.state;
    if (is_new)
    {
        if (change.fields != geom_field::all)
            cursor.refuse("a new geom is not described");
        geoms_.push_back({state.geom_class, false, false, depth_in(cursor, state.parent)});
        recording_.stand_ins_ += state.geom_class == stand_in;
        recording_.geom_count_ = static_cast<std::uint32_t>(geoms_.size());
    }
    Geom &geom = geoms_[id];
    if (geom.gone)
        cursor.refuse("the geom is gone");
    if (geom.geom_class != state.geom_class || is_new != bool(change.fields & geom_field::is_new))
        cursor.refuse("the geom has another class than before");
    if ((change.fields & geom_field::parent) && !is_new)
        cursor.refuse("a geom has moved to another space");
    if (change.fields & geom_field::size)
        check_size(cursor, state);
    if ((change.fields & geom_field::space) && geom.geom_class == dHashSpaceClass)
        check_levels(cursor, state.space);
    const bool has_data = geom.geom_class == dTriMeshClass || geom.geom_class == dConvexClass;
    const Shape shape = geom.geom_class == dConvexClass ? Shape::convex : Shape::mesh;
    if ((change.fields & geom_field::data) && has_data && (state.data >= data_.size() || data_[state.data] != shape))
        cursor.refuse("there are no such data of a mesh or convex");
    if (change.fields & geom_field::body)
    {
        const bool may_have = is_placeable_class(geom.geom_class) || geom.geom_class == stand_in;
        if (state.body > recording_.body_count_ || (state.body != 0 && !may_have))
            cursor.refuse("there is no such body");
        geom.has_body = state.body != 0;
    }
    if ((change.fields & geom_field::offset) && state.has_offset &&
        (!geom.has_body || !is_placeable_class(geom.geom_class)))
        cursor.refuse("a geom without body has an offset from it");
    if (change.fields & geom_field::pose && is_placeable_class(geom.geom_class))
        extend(state.pose);
}

std::uint32_t Recording::Check::take_live(Cursor &cursor) const
{
    const auto id = cursor.take<std::uint32_t>();
    if (id >= geoms_.size() || geoms_[id].gone)
        cursor.refuse("there is no such geom");
    return id;
}

void Recording::Check::take_gone(const Record &record)
{
    Cursor cursor(recording_.bytes_, record);
    geoms_[take_live(cursor)].gone = true;
    cursor.expect_end();
}

void Recording::Check::take_event(const Record &record)
{
    Cursor cursor(recording_.bytes_, record);
    const bool is_collide = record.kind == RecordKind::collide;
    const std::uint32_t first = take_live(cursor);
    const std::uint32_t second = is_collide ? first : take_live(cursor);
    cursor.expect_end();
    const bool first_is_space = is_space_class(geoms_[first].geom_class);
    if (!first_is_space && !is_space_class(geoms_[second].geom_class))
        cursor.refuse("the geom that is asked is no space");
    if (is_collide ? !has_collide_ : !has_collide_ && !has_question_)
        recording_.first_space_ = first_is_space ? first : second;
    has_collide_ |= is_collide;
    has_question_ = true;
    recording_.events_.push_back({recording_.records_.size()});
}

void Recording::Check::take_pairs(const Record &record)
{
    Cursor cursor(recording_.bytes_, record);
    const auto number = cursor.take<std::uint32_t>();
    if (number >= recording_.events_.size() || recording_.events_[number].has_pairs)
        cursor.refuse("there is no such event, or its pairs are known");
    EventSummary &event = recording_.events_[number];
    event.has_pairs = true;
    cursor.take(event.pairs);
    cursor.take(event.hash);
    cursor.expect_end();
}

void Recording::Check::take_end(const Record &record)
{
    Cursor cursor(recording_.bytes_, record);
    const auto reason = cursor.take<std::uint8_t>();
    if (reason > static_cast<std::uint8_t>(EndReason::limit))
        cursor.refuse("there is no such reason to end");
    cursor.expect_end();
    recording_.has_end_ = true;
    recording_.reached_limit_ = reason == static_cast<std::uint8_t>(EndReason::limit);
}

std::uint32_t Recording::id(const Record &record) const
{
    return Cursor(bytes_, record).take<std::uint32_t>();
}

std::array<std::uint32_t, 2> Recording::asked(const Record &record) const
{
    return Cursor(bytes_, record).take<std::array<std::uint32_t, 2>>();
}

BodyChange Recording::body(const Record &record) const
{
    Cursor cursor(bytes_, record);
    BodyChange change{};
    cursor.take(change.id);
    cursor.take(change.fields);
    if (!is_within(change.fields, body_field::all))
        cursor.refuse("a body has no such fields");
    if (change.fields & body_field::flags)
        cursor.take(change.state.flags);
    if (change.fields & body_field::pose)
        cursor.take_reals(change.state.pose.data(), 12);
    if (change.fields & body_field::velocity)
        cursor.take_reals(change.state.velocity.data(), 6);
    cursor.expect_end();
    return change;
}

GeomChange Recording::geom(const Record &record) const
{
    Cursor cursor(bytes_, record);
    GeomChange change{};
    GeomState &state = change.state;
    cursor.take(change.id);
    cursor.take(state.geom_class);
    cursor.take(change.fields);
    if (!is_within(change.fields, geom_field::all))
        cursor.refuse("a geom has no such fields");
    if (state.geom_class > dLastSpaceClass && state.geom_class != stand_in)
        cursor.refuse("there is no such class");
    if (state.geom_class == dGeomTransformClass || state.geom_class == dHeightfieldClass)
        cursor.refuse("geoms of this class are recorded as their boxes");
    if (change.fields & geom_field::space)
        cursor.take(state.space);
    if (change.fields & geom_field::parent)
        cursor.take(state.parent);
    if (change.fields & geom_field::bits)
        cursor.take(state.bits);
    if (change.fields & geom_field::flags)
        cursor.take(state.flags);
    if (change.fields & geom_field::size)
        cursor.take_reals(state.size.data(), size_count(state.geom_class));
    if (change.fields & geom_field::data)
        cursor.take(state.data);
    if (change.fields & geom_field::body)
        cursor.take(state.body);
    if (change.fields & geom_field::offset)
    {
        cursor.take(state.has_offset);
        cursor.take_reals(state.offset.data(), 12);
    }
    if (change.fields & geom_field::pose)
        cursor.take_reals(state.pose.data(), 12);
    cursor.expect_end();
    return change;
}

MeshContent Recording::mesh(const Record &record) const
{
    Cursor cursor(bytes_, record);
    MeshContent mesh{};
    cursor.take_bytes(sizeof(std::uint32_t));
    mesh.single = cursor.take<std::uint8_t>() != 0;
    cursor.take(mesh.vertex_count);
    cursor.take(mesh.triangle_count);
    const std::uint64_t size_of_real = mesh.single ? sizeof(float) : sizeof(double);
    mesh.vertices = cursor.take_bytes(3 * size_of_real * mesh.vertex_count);
    mesh.triangles = cursor.take_bytes(std::uint64_t{3} * sizeof(std::uint32_t) * mesh.triangle_count);
    cursor.expect_end();
    return mesh;
}

ConvexContent Recording::convex(const Record &record) const
{
    Cursor cursor(bytes_, record);
    ConvexContent convex{};
    cursor.take_bytes(sizeof(std::uint32_t));
    cursor.take(convex.plane_count);
    cursor.take(convex.point_count);
    cursor.take(convex.entry_count);
    convex.planes = cursor.take_bytes(std::uint64_t{4} * sizeof(dReal) * convex.plane_count);
    convex.points = cursor.take_bytes(std::uint64_t{3} * sizeof(dReal) * convex.point_count);
    convex.polygons = cursor.take_bytes(std::uint64_t{sizeof(std::uint32_t)} * convex.entry_count);
    cursor.expect_end();
    return convex;
}
} // namespace ode_predictive_space::history
