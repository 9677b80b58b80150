// The dSpace: ODE's side of the broad phase.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_PREDICTIVE_SPACE_H
#define ODE_PREDICTIVE_SPACE_SPACE_PREDICTIVE_SPACE_H

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/broadphase.h"
#include "ode_predictive_space/space/access.h"
#include "ode_predictive_space/space/counted_id_set.h"
#include "ode_predictive_space/space/geom_scene.h"
#include "ode_predictive_space/space/hash_levels.h"
#include "ode_predictive_space/space/off_line_geoms.h"

/// A space that calls its callback for exactly the pairs for which dxSimpleSpace would.
///
/// With few geoms it works as dxSimpleSpace does, until it has to predict. From then on it goes on to predict, and next_ex of each of
/// its geoms holds the proxy number + 1; otherwise that is zero.
struct dxPredictiveSpace : public dxSpaceWithHashLevels
{
    explicit dxPredictiveSpace(dxSpace *parent);
    ~dxPredictiveSpace() override;

    void add(dxGeom *geom) override;
    void remove(dxGeom *geom) override;
    void dirty(dxGeom *geom) override;
    void cleanGeoms() override;
    void collide(void *data, dNearCallback *callback) override;
    void collide2(void *data, dxGeom *geom, dNearCallback *callback) override;

    void set_proximity_test(ode_predictive_space::ProximityTest test);
    void set_shape_margin(double margin);
    void set_role(dxGeom *geom, ode_predictive_space::Role role);
    void set_deviation(int role, const ode_predictive_space::Deviation *deviation);
    void set_horizon(const ode_predictive_space::HorizonBounds &horizon);
    ode_predictive_space::Role role(dxGeom *geom) const;

    /// Brings the broad phase up to date with what has moved, without a tick.
    ///
    /// @return false, after a message, when it is just being brought up to date, by another thread's tick or further up the stack.
    bool catch_up(const char *function);

    /// The same.
    ///
    /// @return holds back the inquiries of other threads as long as it lives; without a mutex when the space cannot be asked now.
    [[nodiscard]] std::unique_lock<std::recursive_mutex> begin_inquiry(const char *function);

    /// The data that a geom of this space is made of have been changed in place.
    void geom_changed(dxGeom *geom);

    /// By the shape test: makes the hulls of all geoms with data, also of those in predictive spaces within this one.
    void make_hulls(const char *function);

    /// A geom that can be met, in ticks from now.
    struct Encounter
    {
        dxGeom *geom;
        double ticks;
    };

    /// The time of proximity of two geoms of this space, in ticks from now. None when they stay apart; then `apart_until` tells
    /// for how many ticks this is known. The space must be caught up.
    std::optional<double> time_of_proximity(dxGeom *first, dxGeom *second, double *apart_until);

    /// All geoms that a geom of this space can meet, the soonest first. The space must be caught up.
    std::vector<Encounter> encounters(dxGeom *geom);

    /// What contradicts the invariant.
    struct Violation
    {
        const char *what = nullptr;                       ///< as a sentence; null when the invariant holds
        const dxGeom *first = nullptr, *second = nullptr; ///< the geoms that it is about, if it is about any
    };

    /// Brings the space up to date, and checks the invariant by brute force.
    Violation find_violation();

    const ode_predictive_space::Broadphase &broadphase() const { return broadphase_; }
    unsigned long ticks() const { return ticks_; }
    unsigned long reported() const { return reported_; }
    unsigned long unchanged() const { return unchanged_; }
    std::size_t bytes() const;

private:
    // The space is locked while it works and while its callbacks run, as ODE's own are. Several threads may ask it at once.
    struct Lock
    {
        explicit Lock(dxSpace *space)
            : space(space), is_only_one(__atomic_fetch_add(&space->lock_count, 1, __ATOMIC_SEQ_CST) == 0)
        {}
        ~Lock() { __atomic_fetch_sub(&space->lock_count, 1, __ATOMIC_SEQ_CST); }
        Lock(const Lock &) = delete;
        Lock &operator=(const Lock &) = delete;
        dxSpace *space;
        bool is_only_one; // when it was made
    };

    using ProxyId = ode_predictive_space::ProxyId;

    static ProxyId proxy_of(const dxGeom *geom);
    ode_predictive_space::GeomScene scene() const;

    // spatial_query.cpp
    struct Question
    {
        dxGeom *geom;
        std::optional<ode_predictive_space::RayProbe> line; // of a ray that is followed along its line
    };
    Question question_of(dxGeom *geom);
    bool is_caught_up() const;
    bool is_free(const char *function) const;
    void ask_each(void *data, dxGeom *geom, dNearCallback *callback);
    void answer(dxGeom *other, const Question &question, bool is_on_line, void *data, dNearCallback *callback);
    bool compute_boxes(const char *function);
    void compute_box(dxGeom *geom);
    void compute_box_of_probe(dxGeom *geom);
    void find_off_line();
    std::size_t find_near(const Question &question, std::vector<ProxyId> &found);
    bool may_touch(dxGeom *geom, const Question &question, bool is_on_line);
    bool shapes_may_meet(dxGeom *geom, dxGeom *probe);
    ode_predictive_space::ConvexShape shape_now(dxGeom *geom);
    std::size_t steps_at_once() const;

    bool by_box() const { return broadphase_.proximity_test() == ode_predictive_space::ProximityTest::box; }
    bool by_sphere() const { return broadphase_.proximity_test() == ode_predictive_space::ProximityTest::sphere; }

    bool by_shape() const { return broadphase_.proximity_test() == ode_predictive_space::ProximityTest::shape; }

    // forecast_query.cpp
    void follow_shapes(const std::vector<ProxyId> &ids, ode_predictive_space::GeomScene &now);
    std::optional<double> time_of_proximity(const ode_predictive_space::CandidatePair &pair,
                                            const ode_predictive_space::Forecast &first,
                                            ode_predictive_space::GeomScene &now, double *apart_until);
    std::vector<ProxyId> members() const;

    // validation.cpp
    Violation find_misplaced(const std::vector<ProxyId> &members, ode_predictive_space::GeomScene &now) const;
    Violation find_missing_pair(const std::vector<ProxyId> &members, const ode_predictive_space::GeomScene &now) const;
    Violation find_touching(ode_predictive_space::GeomScene &now);

    // predictive_space.cpp
    void start_predicting();
    void enrol(dxGeom *geom);
    void dismiss(dxGeom *geom);
    // By the shape test; among few primitives, that does not pay.
    bool looks_at_shapes() { return by_shape() && (predicts_ || has_geoms_with_data()); }
    bool has_geoms_with_data();
    void collide_each(void *data, dNearCallback *callback);
    void clean_each();
    void collide_predicted(bool nested_call, void *data, dNearCallback *callback);
    std::size_t find_reported(bool nested_call, std::vector<ode_predictive_space::CandidatePair> &pairs);
    void call_back(dxGeom *one, dxGeom *other, void *data, dNearCallback *callback);
    void follow_carried(dxGeom *geom);
    void note_followed(dxGeom *geom, ode_predictive_space::Followed followed);
    void look_closely(dxGeom *geom, ode_predictive_space::Followed followed);
    void note_disabled(dxGeom *geom);
    void prepare();
    void poll_moves();
    void note_changed_line(const dxGeom *geom);
    void note_change(ProxyId id);
    void fit_to_proxies();

    enum class HasData : char
    {
        unknown, // geoms have come or gone
        no,
        yes
    };
    std::atomic<HasData> has_data_{HasData::unknown}; // has any geom data? As long as the space does not predict
    bool predicts_ = false;                           // else it has few geoms, and the broad phase has none of them
    ode_predictive_space::Broadphase broadphase_;
    std::vector<dxGeom *> geoms_; // by proxy number; 0 for gaps

    ode_predictive_space::CountedIdSet unclassified_; // added since the last look: their class was not known then
    ode_predictive_space::CountedIdSet polled_;       // geoms whose class changes them without notice
    const dxGeom *moved_mesh_ = nullptr;              // the mesh whose move was noticed last
    ode_predictive_space::OffLineGeoms off_line_;
    ode_predictive_space::Access access_;

    // Taken by collide() and collide2() while they call back, and returned afterwards: a callback may collide this space.
    std::vector<ode_predictive_space::CandidatePair> pairs_;
    std::vector<ProxyId> found_;

    mutable ode_predictive_space::HullStore hulls_; // a scene may make hulls

    unsigned long ticks_ = 0;
    unsigned long reported_ = 0;
    unsigned long unchanged_ = 0; // notices of geoms that had not changed
};

#endif
