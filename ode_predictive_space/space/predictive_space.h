// The dSpace: ODE's side of the broad phase.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_PREDICTIVE_SPACE_H
#define ODE_PREDICTIVE_SPACE_SPACE_PREDICTIVE_SPACE_H

#include <mutex>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/broadphase.h"
#include "ode_predictive_space/space/access.h"
#include "ode_predictive_space/space/geom_scene.h"
#include "ode_predictive_space/space/off_line_geoms.h"

/// By box, the space calls its callback for exactly the pairs of a dxSimpleSpace. With few geoms it works as one until it has
/// to predict, which then never ends. While it predicts, next_ex of each geom holds the proxy number + 1; before, it is null.
struct dxPredictiveSpace : public dxSpace
{
    /// The least and the greatest level of a new hash space. dHashSpaceGetLevels() and dHashSpaceSetLevels() expect them right
    /// after the members of dxSpace.
    int hash_levels[2] = {-3, 10};

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
    void set_settings(const ode_predictive_space::PredictionSettings &settings);
    ode_predictive_space::Role role(dxGeom *geom) const;

    /// Updates the broad phase without a tick. @return false, after a message, if another thread's tick or a caller further up
    /// the stack is updating it.
    bool catch_up(const char *function);

    /// Calls catch_up(). @return a lock under which other threads' queries that write wait; without a mutex if catch_up()
    /// failed.
    [[nodiscard]] std::unique_lock<std::recursive_mutex> begin_query(const char *function);

    void geom_changed(dxGeom *geom);

    /// Makes the hulls of all geoms with data, in this space and in predictive spaces inside it, as far as they test by shape.
    void make_hulls(const char *function);

    struct Encounter
    {
        dxGeom *geom;
        double ticks; // from now
    };

    /// Time of proximity of two geoms of this space, in ticks from now. None if they stay apart for `apart_until` ticks, which
    /// are 0 if a motion is unknown. @pre the space is caught up.
    std::optional<double> time_of_proximity(dxGeom *first, dxGeom *second, double *apart_until);

    /// The geoms that a geom of this space can meet, the soonest first. @pre the space is caught up.
    std::vector<Encounter> encounters(dxGeom *geom);

    struct Violation
    {
        const char *what = nullptr;                       ///< a sentence; null if the invariant holds
        const dxGeom *first = nullptr, *second = nullptr; ///< the geoms concerned, if any
    };

    /// Updates the space, and checks the invariant by brute force.
    Violation find_violation();

    const ode_predictive_space::Broadphase &broadphase() const { return broadphase_; }
    unsigned long ticks() const { return ticks_; }
    unsigned long reported() const { return reported_; }
    unsigned long unchanged() const { return unchanged_; }
    std::size_t bytes() const;

private:
    // Locks the space while it works and calls back, as ODE's spaces do. Several threads may hold locks at once.
    struct Lock
    {
        explicit Lock(dxSpace *space)
            : space(space), is_only_one(__atomic_fetch_add(&space->lock_count, 1, __ATOMIC_SEQ_CST) == 0)
        {}
        ~Lock() { __atomic_fetch_sub(&space->lock_count, 1, __ATOMIC_SEQ_CST); }
        Lock(const Lock &) = delete;
        Lock &operator=(const Lock &) = delete;
        dxSpace *space;
        bool is_only_one; // at its construction
    };

    using ProxyId = ode_predictive_space::ProxyId;

    static ProxyId proxy_of(const dxGeom *geom);
    ode_predictive_space::GeomScene scene() const;

    // spatial_query.cpp
    struct Query
    {
        dxGeom *geom;
        std::optional<ode_predictive_space::RayProbe> line; // for a ray that is followed along its line
    };
    Query query_of(dxGeom *geom);
    bool is_caught_up() const;
    bool is_free(const char *function) const;
    void ask_each(void *data, dxGeom *geom, dNearCallback *callback);
    void answer(dxGeom *other, const Query &query, bool is_on_line, void *data, dNearCallback *callback);
    bool compute_boxes(const char *function);
    void compute_box(dxGeom *geom);
    void compute_box_of_probe(dxGeom *geom);
    void find_off_line();
    std::size_t find_near(const Query &query, std::vector<ProxyId> &found);
    bool may_touch(dxGeom *geom, const Query &query, bool is_on_line);
    bool shapes_may_meet(dxGeom *geom, dxGeom *probe);
    ode_predictive_space::ConvexShape shape_now(dxGeom *geom);
    std::size_t steps_at_once() const;

    bool by_box() const { return broadphase_.proximity_test() == ode_predictive_space::ProximityTest::box; }
    bool by_sphere() const { return broadphase_.proximity_test() == ode_predictive_space::ProximityTest::sphere; }

    bool by_shape() const { return broadphase_.proximity_test() == ode_predictive_space::ProximityTest::shape; }

    // forecast_query.cpp
    std::optional<double> time_of_proximity(const ode_predictive_space::CandidatePair &pair,
                                            const ode_predictive_space::Forecast &first,
                                            ode_predictive_space::GeomScene &now, double *apart_until);

    // validation.cpp
    Violation find_misplaced(const std::vector<ProxyId> &members, ode_predictive_space::GeomScene &now) const;
    Violation find_missing_pair(const std::vector<ProxyId> &members, const ode_predictive_space::GeomScene &now) const;
    Violation find_touching(ode_predictive_space::GeomScene &now);

    // predictive_space.cpp
    void start_predicting();
    void enrol(dxGeom *geom);
    void dismiss(dxGeom *geom);
    // Among few primitives, the shape test does not pay.
    bool tests_shapes() const { return by_shape() && (predicts_ || has_geoms_with_data()); }
    bool has_geoms_with_data() const;
    void collide_each(void *data, dNearCallback *callback);
    void clean_each();
    void collide_predicted(bool nested_call, void *data, dNearCallback *callback);
    std::size_t find_reported(bool nested_call, std::vector<ode_predictive_space::CandidatePair> &pairs);
    void call_back(dxGeom *one, dxGeom *other, void *data, dNearCallback *callback);
    void follow_carried(dxGeom *geom);
    void note_followed(dxGeom *geom, ode_predictive_space::Followed followed);
    void follow_closely(dxGeom *geom, ode_predictive_space::Followed followed);
    void note_disabled(dxGeom *geom);
    void prepare();
    void poll_moves();
    void note_changed_line(const dxGeom *geom);
    void note_change(ProxyId id);
    void fit_to_proxies();

    bool predicts_ = false; // otherwise the broad phase is empty
    ode_predictive_space::Broadphase broadphase_;
    std::vector<dxGeom *> geoms_; // indexed by proxy number; null for gaps

    ode_predictive_space::IdSet unclassified_; // geoms added since the last update, of unknown class
    ode_predictive_space::IdSet polled_;       // meshes and spaces, which change without notice
    const dxGeom *moved_mesh_ = nullptr;       // the mesh of the last notice of a mesh
    ode_predictive_space::OffLineGeoms off_line_;
    ode_predictive_space::Access access_;

    // Moved out by collide() and collide2() during callbacks, which may collide this space again.
    std::vector<ode_predictive_space::CandidatePair> pairs_;
    std::vector<ProxyId> found_;

    mutable ode_predictive_space::HullStore hulls_; // scene() is const, but its scene may make hulls

    unsigned long ticks_ = 0;
    unsigned long reported_ = 0;
    unsigned long unchanged_ = 0; // notices without a change
};

#endif
