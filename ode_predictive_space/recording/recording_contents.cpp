// What records say, field by field. Here and in recorder.cpp the order of the fields is the same.

#include <ode/collision.h>

#include "ode_predictive_space/recording/record_cursor.h"
#include "ode_predictive_space/recording/recording.h"

namespace ode_predictive_space::recording
{
namespace
{
bool is_within(std::uint16_t fields, std::uint16_t all)
{
    return fields != 0 && (fields & ~all) == 0;
}
} // namespace

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
    RecordCursor cursor(bytes_, record);
    GeomChange change{};
    GeomState &state = change.state;
    cursor.take(change.id);
    cursor.take(state.geom_class);
    cursor.take(change.fields);
    if (!is_within(change.fields, geom_field::all))
        cursor.refuse("a geom has no such fields");
    if (state.geom_class > dLastSpaceClass && state.geom_class != stand_in && state.geom_class != fixed_heightfield)
        cursor.refuse("there is no such class");
    if (state.geom_class == dGeomTransformClass)
        cursor.refuse("a transform is recorded as what it holds");
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
    if (change.fields & geom_field::service)
        cursor.take(state.service);
    cursor.expect_end();
    return change;
}

MeshContent Recording::mesh(const Record &record) const
{
    RecordCursor cursor(bytes_, record);
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
    RecordCursor cursor(bytes_, record);
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

HeightsContent Recording::heights(const Record &record) const
{
    RecordCursor cursor(bytes_, record);
    HeightsContent field{};
    cursor.take_bytes(sizeof(std::uint32_t));
    cursor.take(field.columns);
    cursor.take(field.rows);
    field.repeats = cursor.take<std::uint8_t>() != 0;
    for (dReal *number :
         {&field.width, &field.depth, &field.scale, &field.offset, &field.thickness, &field.lowest, &field.highest})
        cursor.take(*number);
    field.samples = cursor.take_bytes(std::uint64_t{sizeof(double)} * field.columns * field.rows);
    cursor.expect_end();
    return field;
}

std::vector<NoticeCount> Recording::notices(const Record &record) const
{
    RecordCursor cursor(bytes_, record);
    std::vector<NoticeCount> counts(record.size / sizeof(NoticeCount));
    for (NoticeCount &count : counts)
        cursor.take(count);
    cursor.expect_end();
    return counts;
}
} // namespace ode_predictive_space::recording
