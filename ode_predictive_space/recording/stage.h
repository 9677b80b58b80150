// The spaces, geoms and bodies of a recording, made again.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_STAGE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_STAGE_H

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include <ode/collision.h>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/space_kind.h"

namespace ode_predictive_space::recording
{
/// ODE must be up. Any number of stages may stand beside each other.
class Stage
{
public:
    /// @param recording outlives the stage.
    /// @param in_spaces false: geoms are put in no space, and nothing can be asked.
    Stage(const Recording &recording, SpaceKind kind, bool in_spaces = true);
    ~Stage();
    Stage(const Stage &) = delete;
    Stage &operator=(const Stage &) = delete;

    /// Of all records but events and what tells of them, in their order: what they change.
    void apply(const Record &record);

    /// Of an event: dSpaceCollide() or dSpaceCollide2(). Nothing with SpaceKind::none.
    void ask(const Record &record, void *data, dNearCallback *callback);

    /// The number of a geom in the recording.
    static std::uint32_t id_of(dGeomID geom);

    dGeomID geom(std::uint32_t id) const { return geoms_[id].geom; }

    /// Of it only the box is known.
    bool is_stand_in(std::uint32_t id) const { return geoms_[id].state.geom_class == stand_in; }

private:
    struct Mesh
    {
        std::vector<char> vertices;
        std::vector<std::uint32_t> triangles;
        dTriMeshDataID data = nullptr; // made when a geom first has it
        bool single = false;
    };
    struct Convex
    {
        std::vector<dReal> planes, points;
        std::vector<unsigned> polygons;
    };
    struct Heights
    {
        std::vector<double> samples;
        dHeightfieldDataID data;
    };
    struct Shape // one of these
    {
        std::unique_ptr<Mesh> mesh;
        std::unique_ptr<Convex> convex;
        std::unique_ptr<Heights> heights;
    };
    struct Geom
    {
        dGeomID geom = nullptr;
        GeomState state;
        std::unique_ptr<dReal[]> box; // of a stand-in
        bool was_reported = false;    // since the last event, that it has moved
    };

    void add_mesh(const MeshContent &content);
    void add_convex(const ConvexContent &content);
    void add_heights(const HeightsContent &content);
    void change_body(const BodyChange &change);
    void change_geom(const GeomChange &change);
    void make(Geom &geom, std::uint32_t id);
    dSpaceID make_space(const GeomState &state) const;
    dSpaceID make_space_of_kind(SpaceKind kind) const;
    dGeomID make_mesh(std::uint32_t data);
    dGeomID make_convex(std::uint32_t data);
    dGeomID make_heightfield(const GeomState &state);
    void place_in_space(const Geom &geom) const;
    void place(std::uint32_t id, std::uint16_t fields);
    void take_offset(const Geom &geom) const;
    static void take_pose(const Geom &geom);
    void report_move(std::uint32_t id);
    void repeat_notices(const std::vector<NoticeCount> &counts);
    void destroy(std::uint32_t id);

    const Recording &recording_;
    SpaceKind kind_;
    bool in_spaces_;
    dWorldID world_;
    std::vector<dBodyID> bodies_;
    std::deque<Geom> geoms_;
    std::vector<Shape> shapes_;
    std::vector<std::uint32_t> reported_; // those that were reported since the last event
};
} // namespace ode_predictive_space::recording

#endif
