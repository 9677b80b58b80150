#ifndef ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_UNIVERSE_H
#define ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_UNIVERSE_H

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"
#include "tests/differential/operation.h"

namespace ode_predictive_space
{
/// One of two universes with the same history, which differ only in the kind of the outermost space and of nested ones of the
/// same kind. Two worlds, not one with twins on its bodies: so the geoms of a body exclude each other in each universe, as in a
/// real program, and contacts can feed back into the motion. Both worlds move alike to the last bit: contacts are made in the
/// order of the geoms' numbers, and dWorldQuickStep()'s random numbers are seeded before each step.
class Universe
{
public:
    Universe(SpaceKind kind, const History &history);
    ~Universe();
    Universe(const Universe &) = delete;
    Universe &operator=(const Universe &) = delete;

    /// Anything but a tick, a calm or a query. An operation on a missing object does nothing.
    void apply(const Operation &operation);

    void step(double seconds);

    /// dSpaceCollide() of the outermost space, with recursion into the nested ones, and in some ticks dSpaceCollide() of these.
    /// The pairs are without order, and sorted.
    Pairs tick();

    /// dSpaceCollide2(), sorted, each pair as it came; empty if one of the two does not exist.
    Pairs query(int first, int second);

    bool valid() const;

    /// Applies to present and future predictive spaces.
    void measure_by(int proximity);

    /// dSpaceCollide() of the outermost space, whose callback queries it for the first geom of each pair. All pairs, sorted.
    Pairs tick_asking();

    /// Number of contacts of dCollide() between two geoms; 0 if it stops at an assertion, as it may for extreme coordinates.
    int contacts_between(int first, int second) const;

    const char *kind_name(int geom) const { return geom_kind_name(geoms_[static_cast<std::size_t>(geom)].kind); }

    std::size_t geom_count() const;
    dSpaceID outermost() const { return spaces_.front().id; }

private:
    struct Drive
    {
        DriveMode mode = DriveMode::none;
        std::array<double, 3> velocity{};
    };
    struct GeomSlot
    {
        dGeomID id = nullptr;
        GeomKind kind = GeomKind::sphere;
        OwnShapeData *own_data = nullptr; ///< in own_data_, if the geom is made from it
        Drive drive;
    };
    struct SpaceSlot
    {
        dSpaceID id = nullptr;
        bool predictive = false;
        bool needs_cleaning =
            false; ///< a space of ODE's own, which may abort when a clean geom is added among dirty ones
    };

    GeomSlot *find_geom(int slot);
    dBodyID find_body(int slot) const;
    SpaceSlot *find_space(int slot);
    dGeomID find_reference(int reference);

    void apply_to_geom(const Operation &operation, GeomSlot &geom);
    void apply_to_body(const Operation &operation, dBodyID body);
    void apply_to_space(const Operation &operation, SpaceSlot &space);
    void apply_to_reference(const Operation &operation, dGeomID geom);
    void make_geom(const Operation &operation);
    void make_body(const Operation &operation);
    void make_space(const Operation &operation);
    dSpaceID create_space(NestedKind kind, dSpaceID parent) const;
    void destroy_body(int slot);
    void destroy_space(int slot);
    void forget_contents(dSpaceID space);
    void put_in(dGeomID geom, SpaceSlot &space);
    void put_offset(dGeomID geom, const Operation &operation);
    void change_in_place(GeomSlot &geom, dReal size);
    void tell_of_change(dGeomID geom);
    void move_driven();
    void turn_back();
    void make_contacts(const Pairs &pairs);
    void break_off(const Operation &operation);
    void throw_bounds(const Operation &operation);
    void ask_times(const Operation &operation);
    void call_badly(int which);
    bool can_touch(int number) const;

    SpaceKind kind_;
    History setup_;
    dWorldID world_;
    dJointGroupID contacts_;
    std::vector<std::unique_ptr<OwnShapeData>> own_data_; // kept until the end, as spaces destroy geoms, too
    std::vector<GeomSlot> geoms_;
    std::vector<dBodyID> bodies_;
    std::vector<SpaceSlot> spaces_;
    int proximity_ = 0; // a dPredictiveProximity constant
    unsigned long steps_ = 0;
    unsigned long ticks_ = 0;
};
} // namespace ode_predictive_space

#endif
