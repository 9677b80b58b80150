#include "ode_predictive_space/recording/shape_data.h"

#include <cmath>
#include <cstring>
#include <tuple>

#include "ode_predictive_space/ode/height_data.h"
#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/ode/mesh_data.h"
#include "ode_predictive_space/recording/format.h"

namespace ode_predictive_space::recording
{
namespace
{
void append(std::string &content, const void *bytes, std::size_t size)
{
    content.append(static_cast<const char *>(bytes), size);
}

void append(std::string &content, std::uint32_t number)
{
    append(content, &number, sizeof number);
}

template <typename Real> bool append_vertices(std::string &content, const TriangleArrays &mesh)
{
    for (unsigned i = 0; i < mesh.vertex_count; ++i)
    {
        const Vector3 vertex = mesh.vertex(i);
        if (!vertex.allFinite())
            return false;
        const Eigen::Matrix<Real, 3, 1> as_stored = vertex.cast<Real>();
        append(content, as_stored.data(), 3 * sizeof(Real));
    }
    return true;
}

bool read_mesh(const TriangleArrays &mesh, std::string &content)
{
    if (mesh.triangle_count == 0 || mesh.triangle_count > most_of_mesh || mesh.vertex_count > most_of_mesh)
        return false;
    content.push_back(mesh.single ? 1 : 0);
    append(content, mesh.vertex_count);
    append(content, mesh.triangle_count);
    if (!(mesh.single ? append_vertices<float>(content, mesh) : append_vertices<double>(content, mesh)))
        return false;
    for (unsigned i = 0; i < mesh.triangle_count; ++i)
    {
        const TriangleArrays::Indices corners = mesh.indices(i);
        for (std::uint32_t corner : corners)
            if (corner >= mesh.vertex_count)
                return false;
        append(content, corners.data(), sizeof corners);
    }
    return true;
}

bool read_convex(const dxConvex &convex, std::string &content)
{
    std::uint32_t entries = 0;
    for (unsigned i = 0; i < convex.planecount; ++i)
    {
        const unsigned corners = convex.polygons[entries];
        if (corners < 3 || corners > most_polygon_entries - entries)
            return false;
        for (unsigned corner = 1; corner <= corners; ++corner)
            if (convex.polygons[entries + corner] >= convex.pointcount)
                return false;
        entries += corners + 1;
        if (entries > most_polygon_entries)
            return false;
    }
    if (entries == 0 || convex.pointcount == 0 || convex.pointcount > most_polygon_entries)
        return false;
    append(content, convex.planecount);
    append(content, convex.pointcount);
    append(content, entries);
    append(content, convex.planes, sizeof(dReal) * 4 * convex.planecount);
    append(content, convex.points, sizeof(dReal) * 3 * convex.pointcount);
    append(content, convex.polygons, sizeof(unsigned) * entries);
    return true;
}

// ODE computes a height as sample times scale plus offset. These numbers are recorded, so that a replay has the same heights.
bool read_heights(const HeightSamples &field, std::string &content)
{
    const std::int64_t count = std::int64_t{field.columns} * field.rows;
    if (field.columns < 2 || field.rows < 2 || count > most_of_mesh || std::isnan(field.lowest) ||
        std::isnan(field.highest))
        return false;
    append(content, static_cast<std::uint32_t>(field.columns));
    append(content, static_cast<std::uint32_t>(field.rows));
    content.push_back(field.repeats ? 1 : 0);
    for (const dReal number : {field.width, field.depth, field.scale, field.offset, field.thickness})
    {
        if (!std::isfinite(number))
            return false;
        append(content, &number, sizeof number);
    }
    append(content, &field.lowest, sizeof field.lowest);
    append(content, &field.highest, sizeof field.highest);
    for (int row = 0; row < field.rows; ++row)
        for (int column = 0; column < field.columns; ++column)
        {
            const double sample = field.sample(column, row);
            if (!std::isfinite(sample))
                return false;
            append(content, &sample, sizeof sample);
        }
    return true;
}

std::uint64_t hash_of(const std::string &content)
{
    std::uint64_t hash = content.size();
    for (std::size_t i = 0; i < content.size(); i += sizeof(std::uint64_t))
    {
        std::uint64_t word = 0;
        std::memcpy(&word, content.data() + i, std::min(sizeof word, content.size() - i));
        hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
        hash ^= hash >> 32;
    }
    return hash;
}
bool is_sampled_once(dGeomID geom)
{
    return geom->type == dHeightfieldClass && height_data_of(geom)->source == HeightSamples::callback;
}
} // namespace

bool ShapeData::Key::operator<(const Key &other) const
{
    return std::tie(first, second, third, numbers, sizes) <
           std::tie(other.first, other.second, other.third, other.numbers, other.sizes);
}

bool ShapeData::key_of(dGeomID geom, Key &key)
{
    if (geom->type == dConvexClass)
    {
        const auto *convex = static_cast<const dxConvex *>(geom);
        key = {convex->points, convex->polygons, convex->planes, {convex->planecount, convex->pointcount}, {}};
        return true;
    }
    if (geom->type == dHeightfieldClass)
    {
        const HeightSamples *field = height_data_of(geom);
        if (!field)
            return false;
        key = {field,
               field->samples,
               field->user_data,
               {static_cast<std::uint32_t>(field->columns), static_cast<std::uint32_t>(field->rows),
                static_cast<std::uint32_t>(field->source)},
               {field->width, field->depth, field->scale, field->offset}};
        return true;
    }
    const TriangleArrays *mesh = mesh_data_of(geom);
    if (!mesh)
        return false;
    key = {mesh->vertices,
           mesh->triangles,
           nullptr,
           {mesh->vertex_count, mesh->triangle_count, static_cast<std::uint32_t>(mesh->vertex_stride),
            static_cast<std::uint32_t>(mesh->triangle_stride), mesh->single},
           {}};
    return true;
}

bool ShapeData::read(dGeomID geom, std::string &content)
{
    content.clear();
    if (geom->type == dConvexClass)
        return read_convex(*static_cast<const dxConvex *>(geom), content);
    if (geom->type == dHeightfieldClass)
    {
        const HeightSamples *field = height_data_of(geom);
        return field && read_heights(*field, content);
    }
    const TriangleArrays *mesh = mesh_data_of(geom);
    return mesh && read_mesh(*mesh, content);
}

bool ShapeData::find(dGeomID geom, std::uint64_t collide, Entry &entry, std::string &content)
{
    Key key{};
    if (!key_of(geom, key))
        return false;
    const auto known = known_.find(key);
    if (known != known_.end() && (collide == 0 || known->second.looked_at == collide || is_sampled_once(geom)))
    {
        entry = {known->second.id, false};
        return true;
    }
    if (!read(geom, content))
        return false;
    const auto [same, is_new] = by_hash_.emplace(hash_of(content), next_);
    next_ += is_new;
    known_[key] = {same->second, collide};
    entry = {same->second, is_new};
    return true;
}
} // namespace ode_predictive_space::recording
