#include "ode_predictive_space/recording/recording.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <ode/collision.h>

#include "ode_predictive_space/recording/fields.h"
#include "ode_predictive_space/recording/record_cursor.h"

namespace ode_predictive_space::recording
{
Recording Recording::read(const std::string &path)
{
    std::error_code none;
    if (std::filesystem::is_directory(path, none))
        throw std::runtime_error("this is a folder, not a recording");
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

std::size_t Recording::whole_bytes() const
{
    if (records_.empty())
        return std::min(bytes_.size(), header_size);
    return records_.back().content + records_.back().size;
}

GeomState Recording::state_of_first_space() const
{
    for (const Record &record : records_)
        if (record.kind == RecordKind::geom && id(record) == first_space_)
            return geom(record).state;
    GeomState none;
    none.geom_class = dHashSpaceClass;
    return none;
}

std::uint32_t Recording::id(const Record &record) const
{
    return RecordCursor(bytes_, record).take<std::uint32_t>();
}

std::array<std::uint32_t, 2> Recording::asked(const Record &record) const
{
    return RecordCursor(bytes_, record).take<std::array<std::uint32_t, 2>>();
}

BodyChange Recording::body(const Record &record) const
{
    RecordCursor cursor(bytes_, record);
    BodyChange change{};
    cursor.take(change.id);
    cursor.take(change.fields);
    if (change.fields == 0 || (change.fields & ~body_field::all) != 0)
        cursor.refuse("a body has unknown fields or none");
    visit_body_fields(change.state, change.fields, [&](void *field, std::size_t size) { cursor.take_to(field, size); });
    cursor.expect_end();
    return change;
}

GeomChange Recording::geom(const Record &record) const
{
    RecordCursor cursor(bytes_, record);
    GeomChange change{};
    const std::uint8_t &geom_class = change.state.geom_class;
    cursor.take(change.id);
    cursor.take(change.state.geom_class);
    cursor.take(change.fields);
    if (change.fields == 0 || (change.fields & ~geom_field::all) != 0)
        cursor.refuse("a geom has unknown fields or none");
    if (geom_class > dLastSpaceClass && geom_class != stand_in && geom_class != fixed_heightfield)
        cursor.refuse("the class of a geom is unknown");
    if (geom_class == dGeomTransformClass)
        cursor.refuse("a geom has the class of transforms, which is never recorded");
    visit_geom_fields(change.state, change.fields, [&](void *field, std::size_t size) { cursor.take_to(field, size); });
    cursor.expect_end();
    return change;
}

std::vector<NoticeCount> Recording::notices(const Record &record) const
{
    RecordCursor cursor(bytes_, record);
    std::vector<NoticeCount> counts;
    cursor.take_all(counts, record.size / sizeof(NoticeCount));
    cursor.expect_end();
    return counts;
}
} // namespace ode_predictive_space::recording
