#ifndef ODE_PREDICTIVE_SPACE_RECORDING_STAGE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_STAGE_H

#include <cstdint>
#include <deque>
#include <memory>
#include <unordered_map>
#include <vector>

#include <ode/collision.h>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/space_kind.h"

namespace ode_predictive_space::recording
{
/// The spaces, geoms and bodies of a replay. ODE must be initialised.
class Stage
{
public:
    /// @param recording outlives the stage. @param in_spaces false: geoms are put in no space, and nothing can be collided.
    Stage(const Recording &recording, SpaceKind kind, bool in_spaces = true);
    ~Stage();
    Stage(const Stage &) = delete;
    Stage &operator=(const Stage &) = delete;

    /// Makes the changes of a record that is no event. To be called for all of them, in their order.
    void apply(const Record &record);

    /// Calls dSpaceCollide() or dSpaceCollide2() for an event; nothing with SpaceKind::none.
    void ask(const Record &record, void *data, dNearCallback *callback);

    static std::uint32_t id_of(dGeomID geom);

    dGeomID geom(std::uint32_t id) const { return geoms_[id].geom; }

    bool is_stand_in(std::uint32_t id) const { return geoms_[id].state.geom_class == stand_in; }

private:
    struct Geom
    {
        dGeomID geom = nullptr;
        GeomState state;
        std::unique_ptr<dReal[]> box; // of a stand-in
        bool was_reported = false;    // as moved, since the last event
    };

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
    std::unordered_map<std::uint32_t, dTriMeshDataID> meshes_;      // by id of the data, from their first geom on
    std::unordered_map<std::uint32_t, dHeightfieldDataID> heights_; // as meshes_
    std::vector<std::uint32_t> reported_; // geoms that were reported as moved since the last event
};
} // namespace ode_predictive_space::recording

#endif
