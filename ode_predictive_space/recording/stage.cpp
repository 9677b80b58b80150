#include "ode_predictive_space/recording/stage.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <ode/ode.h>

#include "ode_predictive_space/ode/height_data.h"
#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/recording/fields.h"
#include "ode_predictive_space/recording/geom_of_state.h"

namespace ode_predictive_space::recording
{
namespace
{
// About one geom per leaf, the fastest of the depths that were measured.
int quadtree_depth(std::uint32_t geoms)
{
    return std::clamp(static_cast<int>(std::lround(std::log2(std::max(geoms, 1u)) / 2)), 1, 8);
}
} // namespace

Stage::Stage(const Recording &recording, SpaceKind kind, bool in_spaces)
    : recording_(recording), kind_(kind), in_spaces_(in_spaces), world_(dWorldCreate())
{}

Stage::~Stage()
{
    for (std::size_t id = 0; id < geoms_.size(); ++id)
        destroy(static_cast<std::uint32_t>(id));
    for (const auto &mesh : meshes_)
        dGeomTriMeshDataDestroy(mesh.second);
    for (const auto &heights : heights_)
        dGeomHeightfieldDataDestroy(heights.second);
    dWorldDestroy(world_);
}

std::uint32_t Stage::id_of(dGeomID geom)
{
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)));
}

void Stage::apply(const Record &record)
{
    switch (record.kind)
    {
    case RecordKind::body:
        return change_body(recording_.body(record));
    case RecordKind::geom:
        return change_geom(recording_.geom(record));
    case RecordKind::notices:
        return repeat_notices(recording_.notices(record));
    case RecordKind::gone:
        return destroy(recording_.id(record));
    default:
        return;
    }
}

void Stage::ask(const Record &record, void *data, dNearCallback *callback)
{
    for (const std::uint32_t id : reported_)
        geoms_[id].was_reported = false;
    reported_.clear();
    // The ids are always looked up, so that this costs the same with all spaces.
    if (record.kind == RecordKind::collide)
    {
        const dGeomID space = geom(recording_.id(record));
        if (kind_ != SpaceKind::none)
            dSpaceCollide(reinterpret_cast<dSpaceID>(space), data, callback);
        return;
    }
    const auto asked = recording_.asked(record);
    const dGeomID first = geom(asked[0]), second = geom(asked[1]);
    if (kind_ != SpaceKind::none)
        dSpaceCollide2(first, second, data, callback);
}

// Moves a body as a step of ODE does: the matrix is set to the bit, and then each geom of the body is reported as moved.
void Stage::change_body(const BodyChange &change)
{
    if (change.id == bodies_.size())
        bodies_.push_back(dBodyCreate(world_));
    const dBodyID body = bodies_[change.id];
    const BodyState &state = change.state;
    if (change.fields & body_field::flags)
    {
        if (state.flags & body_kinematic)
            dBodySetKinematic(body);
        else if (dBodyIsKinematic(body))
            dBodySetDynamic(body);
        if (state.flags & body_enabled)
            dBodyEnable(body);
        else
            dBodyDisable(body);
    }
    if (change.fields & body_field::velocity)
    {
        const auto &velocity = state.velocity;
        dBodySetLinearVel(body, velocity[0], velocity[1], velocity[2]);
        dBodySetAngularVel(body, velocity[3], velocity[4], velocity[5]);
    }
    if (change.fields & body_field::pose)
    {
        copy_rotation(state.pose, const_cast<dReal *>(dBodyGetRotation(body)));
        std::copy_n(state.pose.begin(), 3, const_cast<dReal *>(dBodyGetPosition(body)));
        for (dGeomID geom = dBodyGetFirstGeom(body); geom; geom = dBodyGetNextGeom(geom))
            report_move(id_of(geom));
    }
}

dSpaceID Stage::make_space_of_kind(SpaceKind kind) const
{
    const std::array<double, 6> &extent = recording_.extent();
    dVector3 centre{}, half{};
    switch (kind)
    {
    case SpaceKind::simple:
    case SpaceKind::none:
        return dSimpleSpaceCreate(nullptr);
    case SpaceKind::sap:
        return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    case SpaceKind::quadtree:
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            centre[axis] = static_cast<dReal>((extent[2 * axis] + extent[2 * axis + 1]) / 2);
            half[axis] = static_cast<dReal>((extent[2 * axis + 1] - extent[2 * axis]) / 2 + 1);
        }
        return dQuadTreeSpaceCreate(nullptr, centre, half, quadtree_depth(recording_.geom_count()));
    case SpaceKind::hash:
        return dHashSpaceCreate(nullptr);
    default:
    {
        const dSpaceID space = dPredictiveSpaceCreate(nullptr);
        dPredictiveSpaceSetProximity(space, kind == SpaceKind::sphere  ? dPredictiveProximitySphere
                                            : kind == SpaceKind::shape ? dPredictiveProximityShape
                                                                       : dPredictiveProximityBox);
        return space;
    }
    }
}

dSpaceID Stage::make_space(const GeomState &state) const
{
    const bool stays_simple = state.geom_class == dSimpleSpaceClass && state.parent != 0;
    const SpaceKind kind = kind_ == SpaceKind::own || stays_simple ? own_kind(state) : kind_;
    const dSpaceID space = make_space_of_kind(kind);
    dSpaceSetCleanup(space, 0);
    return space;
}

dGeomID Stage::make_mesh(std::uint32_t id)
{
    dTriMeshDataID &data = meshes_[id];
    if (!data)
    {
        const auto &mesh = std::get<MeshContent>(recording_.data(id));
        const std::size_t stride = 3 * (mesh.single ? sizeof(float) : sizeof(double));
        data = dGeomTriMeshDataCreate();
        (mesh.single ? dGeomTriMeshDataBuildSingle : dGeomTriMeshDataBuildDouble)(
            data, mesh.vertices.data(), static_cast<int>(stride), static_cast<int>(mesh.vertices.size() / stride),
            mesh.triangles.data(), static_cast<int>(mesh.triangles.size()), 3 * sizeof(dTriIndex));
    }
    return dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
}

dGeomID Stage::make_convex(std::uint32_t id)
{
    const auto &convex = std::get<ConvexContent>(recording_.data(id));
    return dCreateConvex(nullptr, convex.planes.data(), static_cast<unsigned>(convex.planes.size() / 4),
                         convex.points.data(), static_cast<unsigned>(convex.points.size() / 3), convex.polygons.data());
}

dGeomID Stage::make_heightfield(const GeomState &state)
{
    dHeightfieldDataID &data = heights_[state.data];
    if (!data)
    {
        const auto &field = std::get<HeightsContent>(recording_.data(state.data));
        data = dGeomHeightfieldDataCreate();
        dGeomHeightfieldDataBuildDouble(data, field.samples.data(), 0, field.width, field.depth,
                                        static_cast<int>(field.columns), static_cast<int>(field.rows), field.scale,
                                        field.offset, field.thickness, field.repeats);
        if (HeightSamples *known = writable_height_data(data))
        {
            known->lowest = field.lowest;
            known->highest = field.highest;
        }
    }
    return dCreateHeightfield(nullptr, data, state.geom_class == dHeightfieldClass);
}

void Stage::make(Geom &geom, std::uint32_t id)
{
    const GeomState &state = geom.state;
    if (is_space_class(state.geom_class))
        geom.geom = reinterpret_cast<dGeomID>(make_space(state));
    else if (state.geom_class == dTriMeshClass)
        geom.geom = make_mesh(state.data);
    else if (state.geom_class == dConvexClass)
        geom.geom = make_convex(state.data);
    else if (is_heightfield(state.geom_class))
        geom.geom = make_heightfield(state);
    else
        geom.geom = make_simple_shape(state);
    if (state.geom_class == stand_in)
    {
        geom.box = std::make_unique<dReal[]>(6);
        *static_cast<const dReal **>(dGeomGetClassData(geom.geom)) = geom.box.get();
    }
    // A number, not an address. NOLINTNEXTLINE(performance-no-int-to-ptr)
    dGeomSetData(geom.geom, reinterpret_cast<void *>(static_cast<std::uintptr_t>(id)));
}

namespace
{
void update(GeomState &state, const GeomChange &change)
{
    const GeomState &now = change.state;
    state.geom_class = now.geom_class;
    visit_geom_fields(now, change.fields, [&](const void *field, std::size_t size) {
        const auto offset = static_cast<const char *>(field) - reinterpret_cast<const char *>(&now);
        std::memcpy(reinterpret_cast<char *>(&state) + offset, field, size);
    });
}
} // namespace

// A geom with other data is made again, because ODE has no function that replaces all that depends on them.
void Stage::change_geom(const GeomChange &change)
{
    std::uint16_t fields = change.fields;
    if (fields & geom_field::is_new)
        geoms_.emplace_back();
    Geom &geom = geoms_[change.id];
    update(geom.state, change);
    const GeomState &state = geom.state;
    if (geom.geom && (fields & geom_field::data) && has_data(state.geom_class))
    {
        dGeomDestroy(geom.geom);
        fields = geom_field::all;
    }
    if (fields & geom_field::is_new)
        make(geom, change.id);
    if (fields & geom_field::space && is_space_class(state.geom_class))
        set_levels(reinterpret_cast<dSpaceID>(geom.geom), state);
    if (fields & geom_field::bits)
    {
        dGeomSetCategoryBits(geom.geom, state.bits[0]);
        dGeomSetCollideBits(geom.geom, state.bits[1]);
    }
    if (fields & geom_field::flags)
        set_flags(geom.geom, state);
    if (fields & geom_field::size)
        set_size(geom.geom, state);
    place(change.id, fields);
    if (fields & geom_field::parent)
        place_in_space(geom);
}

void Stage::place(std::uint32_t id, std::uint16_t fields)
{
    Geom &geom = geoms_[id];
    const GeomState &state = geom.state;
    const bool is_box = state.geom_class == stand_in;
    if (!is_placeable_class(state.geom_class) && !is_box)
        return;
    if (fields & geom_field::body)
    {
        // dGeomSetBody() also removes an offset, but leaves the flag that the pose has to be computed.
        if (dGeomIsOffset(geom.geom))
            dGeomClearOffset(geom.geom);
        dGeomSetBody(geom.geom, state.body ? bodies_[state.body - 1] : nullptr);
        fields |= geom_field::offset | geom_field::pose;
    }
    if (is_box)
    {
        std::copy_n(state.size.begin(), 6, geom.box.get());
        if (fields & geom_field::size)
            report_move(id);
        return;
    }
    if ((fields & geom_field::offset) && state.body)
        take_offset(geom);
    if (!(fields & geom_field::pose) || !has_own_pose(state))
        return;
    take_pose(geom);
    if (!state.body)
        report_move(id);
}

void Stage::take_offset(const Geom &geom) const
{
    const GeomState &state = geom.state;
    if (state.has_offset)
    {
        dMatrix3 rotation{};
        copy_rotation(state.offset, rotation);
        dGeomSetOffsetRotation(geom.geom, rotation);
        dGeomSetOffsetPosition(geom.geom, state.offset[0], state.offset[1], state.offset[2]);
    }
    else if (dGeomIsOffset(geom.geom))
        dGeomClearOffset(geom.geom);
}

namespace
{
bool is_at(const dxPosR &place, const Pose &pose)
{
    dxPosR recorded = place;
    std::copy_n(pose.begin(), 3, recorded.pos);
    copy_rotation(pose, recorded.R);
    return std::memcmp(&recorded, &place, sizeof place) == 0;
}
} // namespace

// Leaves the pose of a geom with an offset to ODE, unless ODE computes another one from the body than was recorded.
void Stage::take_pose(const Geom &geom)
{
    dxGeom &self = *geom.geom;
    if (self.offset_posr)
        self.computePosr(); // always, so that this costs the same with all spaces
    if (is_at(*self.final_posr, geom.state.pose))
        return;
    copy_rotation(geom.state.pose, self.final_posr->R);
    std::copy_n(geom.state.pose.begin(), 3, self.final_posr->pos);
    self.gflags &= ~GEOM_POSR_BAD;
}

// Reports each change at once, as the program did: to a predictive space, a second notice at the same pose means a new shape.
void Stage::report_move(std::uint32_t id)
{
    dGeomMoved(geoms_[id].geom);
    if (!geoms_[id].was_reported)
        reported_.push_back(id);
    geoms_[id].was_reported = true;
}

void Stage::repeat_notices(const std::vector<NoticeCount> &counts)
{
    for (const NoticeCount &count : counts)
    {
        const Geom &geom = geoms_[count.id];
        for (std::uint32_t i = geom.was_reported ? 1 : 0; i < count.number; ++i)
            dGeomMoved(geom.geom);
        if (geom.state.has_offset && count.number > 0)
            take_pose(geom);
    }
}

void Stage::place_in_space(const Geom &geom) const
{
    if (const dSpaceID before = dGeomGetSpace(geom.geom))
        dSpaceRemove(before, geom.geom);
    const std::uint32_t parent = geom.state.parent;
    if (in_spaces_ && parent != 0 && geoms_[parent - 1].geom)
        dSpaceAdd(reinterpret_cast<dSpaceID>(geoms_[parent - 1].geom), geom.geom);
}

void Stage::destroy(std::uint32_t id)
{
    if (geoms_[id].geom)
        dGeomDestroy(geoms_[id].geom);
    geoms_[id].geom = nullptr;
}
} // namespace ode_predictive_space::recording
