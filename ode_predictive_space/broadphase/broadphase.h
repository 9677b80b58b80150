// The broad phase with predictive scheduling. In: objects by number, and reports of their moves. Out: at each tick, the pairs
// whose bounding boxes overlap.
//
//     moves -> verify -> predict -> index -> schedule -> near set -> pairs
//
// Invariant: at each tick, after verification, every object lies inside its envelope. Therefore a pair whose envelopes are
// apart at this tick is apart, and every pair whose bounding boxes overlap is in the near set.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BROADPHASE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BROADPHASE_H

#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/base/clock.h"
#include "ode_predictive_space/broadphase/index/envelope_index.h"
#include "ode_predictive_space/broadphase/near/near_set.h"
#include "ode_predictive_space/broadphase/predict/predictor.h"
#include "ode_predictive_space/broadphase/schedule/schedule.h"
#include "ode_predictive_space/broadphase/sweep/sweeping.h"
#include "ode_predictive_space/broadphase/verify/idle_objects.h"
#include "ode_predictive_space/broadphase/verify/verifier.h"

namespace ode_predictive_space
{
/// What has been done so far; see dPredictiveSpaceStats.
struct Counters
{
    std::uint64_t moved = 0;
    std::uint64_t verified = 0;
    std::uint64_t violations = 0;
    std::uint64_t repredictions = 0;
    std::uint64_t woken = 0;
    std::uint64_t sweeps = 0;
    std::uint64_t looks = 0; ///< at gaps between shapes
};

/// Owns the stages of the tick, and hands the results of each to the next. No stage knows another.
///
/// When an exception leaves a function here, what was known is given up: the next update sweeps the whole scene, and is exact.
class Broadphase
{
public:
    /// @param scene_epsilon of the scene's coordinates, if these are in single precision; 0 for double precision.
    explicit Broadphase(double scene_epsilon = 0) : proxies_(scene_epsilon) {}

    // --- Objects ---

    /// Makes room for one more object, so that the next add() throws nothing. On an exception no object has changed.
    void make_room();
    /// A new object; it counts as moved.
    ProxyId add();
    /// Throws nothing.
    void remove(ProxyId id);

    /// The object's position, size or anything else about its bounds may have changed, just now. Every change must be reported.
    ///
    /// @param object see Verifier::report_move().
    /// @return false when nothing has changed since the last report: that counts as no move.
    template <typename Object> bool report_move(ProxyId id, const Object &object)
    {
        return report_at_once(id, object) || report_closely(id, object);
    }

    /// Its two halves. The first one is short and true for nearly all reports.
    template <typename Object> bool report_at_once(ProxyId id, const Object &object)
    {
        return verifier_.report_at_once(proxies_, id, object, clock_.expected());
    }
    template <typename Object> bool report_closely(ProxyId id, const Object &object)
    {
        return verifier_.report_closely(proxies_, id, object, clock_.expected());
    }

    /// The object may have changed in any way since it was looked at.
    void mark_moved(ProxyId id) { verifier_.mark_moved(id); }
    /// The object is made of other data.
    void mark_changed(ProxyId id)
    {
        shapes_.forget(id);
        mark_moved(id);
    }

    /// Objects that were added, or whose moves were reported, since the last update.
    const IdSet &changed() { return verifier_.collect_moves(); }

    /// A pair of the object came up for report, and the object is disabled.
    void note_disabled(ProxyId id) { predictor_.request(id); }

    // --- The tick ---

    /// One tick: brings predictions and near set up to date. Time passes only when something has moved.
    void tick(Scene &scene) { update(scene, true); }

    /// The same without a tick: for questions between ticks.
    void catch_up(Scene &scene) { update(scene, false); }

    /// Finds the pairs that overlap now. The broad phase must be up to date.
    ///
    /// @param room where the pairs are written, from its beginning on. It grows as needed and never shrinks; elements behind
    ///     the pairs mean nothing.
    /// @return their number.
    std::size_t report(Scene &scene, std::vector<CandidatePair> &room);

    // --- Questions; the broad phase must be up to date ---

    /// Calls visit(id) for every object whose bounds may overlap `box`.
    template <typename Visit> void query(const FloatBox &box, Visit visit) const { walk(BoxProbe(box), visit); }

    /// The same for a probe of any shape; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const;

    /// When two objects may be near, in ticks from now on; none when they stay apart over their horizons.
    std::optional<ProximityInterval> time_of_proximity(ProxyId first, ProxyId second) const
    {
        return PairProximity(proxies_, first, clock_.now(), proximity_test_).to(second);
    }

    /// Brings the shapes of objects up to date for time_of_contact(). By the shape test only.
    void follow_shapes(Scene &scene, const IdSet &wanted);

    /// By the shape test: when the shapes of two objects may touch, in ticks from now on; 0 when they may now, none when they stay
    /// apart over their horizons. Both are predicted, and their shapes are up to date.
    std::optional<double> time_of_contact(ProxyId first, ProxyId second) const;

    /// By the shape test: whether the shapes of two objects may touch now. The objects need no predictions; their shapes are up to date.
    bool may_touch(ProxyId first, ProxyId second) const;

    /// Predictions are asked for: has them made in the next update if there are none because most objects are new.
    ///
    /// @return true when there will be new ones.
    bool want_predictions();

    /// Has all objects that wait for predictions, however many, predicted in the next update.
    void predict_all_waiting();

    // --- Settings ---

    ProximityTest proximity_test() const { return proximity_test_; }
    void set_proximity_test(ProximityTest test);

    double shape_margin() const { return shape_margin_; }
    /// By the shape test, pairs up to this distance are reported. @param margin finite and not negative.
    void set_shape_margin(double margin);

    const PredictionSettings &settings() const { return predictor_.settings; }
    /// All objects are predicted anew by these settings at the next tick.
    void set_settings(const PredictionSettings &settings);

    /// Fixes an object's role; its next prediction, at the next tick, follows it.
    void set_role(ProxyId id, Role role) { predictor_.set_role(proxies_, id, role); }

    // --- What it knows ---

    const ProxyStore &proxies() const { return proxies_; }
    Tick now() const { return clock_.now(); }
    Mode mode() const { return sweeping_.mode(); }
    const Counters &counters() const { return counters_; }

    /// Has the object a path and an envelope? While the scene is swept not all have.
    bool predicted(ProxyId id) const { return proxies_.predicted(id); }
    /// Is the object disabled, as far as was noticed? Its pairs are not in the near set.
    bool idle(ProxyId id) const { return idle_.contains(id); }

    /// Pairs that are tested at each tick, stale ones among them.
    std::size_t tested_pairs() const { return sweeping_.finds_pairs() ? sweeping_.pairs() : near_.active().size(); }
    /// Pairs that may overlap now, tested or at rest.
    std::size_t near_pairs() const;
    /// Pairs that sleep until their time of proximity.
    std::size_t scheduled_pairs() const { return schedule_.pairs(proxies_); }

    /// Calls visit(pair, state) for each pair that may overlap now.
    template <typename Visit> void for_each_near_pair(Visit visit) const
    {
        if (!sweeping_.finds_pairs())
            near_.for_each(visit);
        else
            sweeping_.for_each_pair(proxies_.members(),
                                    [&](const CandidatePair &pair) { visit(pair, PairState::active); });
    }

    /// Pairs that are not tested because their shapes cannot touch yet.
    std::size_t postponed_pairs() const;

    /// Calls visit(pair) for each of these that cannot touch even now. The broad phase must be up to date.
    template <typename Visit> void for_each_postponed(Scene &scene, Visit visit)
    {
        shapes_.update(scene, near_.members(), proxies_.members());
        if (!sweeping_.finds_pairs())
            near_.for_each_postponed(shapes_, visit);
    }

    bool consistent() const { return index_.consistent(); }
    std::size_t bytes() const;

private:
    /// How an update begins.
    struct Beginning
    {
        std::size_t moves = 0;    ///< number of objects that have moved
        bool needed = false;      ///< something has moved, or is to be predicted
        bool time_passed = false; ///< by a tick
        bool as_expected = false; ///< it is the tick by which reported moves were judged
    };

    void update(Scene &scene, bool is_tick);
    Beginning begin(Scene &scene, bool is_tick);
    void choose_mode(Scene &scene, bool time_passed);
    void verify(Scene &scene, const Beginning &beginning);
    bool has_work() const;
    void limit_batch(std::size_t broken);
    void predict(Scene &scene);
    void find_pairs();
    void schedule();
    void sweep(Scene &scene);
    void finish_work();
    void finish();

    OverlapTest overlap_test(Scene &scene) const;
    CandidatePair *report_swept(Scene &scene, CandidatePair *room);
    CandidatePair *report_near(Scene &scene, CandidatePair *room);
    CandidatePair *report_by_shape(Scene &scene, CandidatePair *room);
    void start_sweeping(bool with_new_objects);
    void recover();
    void forget(ProxyId id);
    std::size_t count_new() const;
    std::size_t most_at_once() const;
    void resize_stages();
    void trim();

    Clock clock_;
    ProxyStore proxies_;
    MeasuredBoxes boxes_;
    MeasuredShapes shapes_; // in use by the shape test
    IdleObjects idle_;
    Verifier verifier_;
    Predictor predictor_;
    EnvelopeIndex index_;
    Schedule schedule_;
    NearSet near_;
    Sweeping sweeping_;

    ProximityTest proximity_test_ = ProximityTest::box;
    double shape_margin_ = 0;
    Counters counters_;
    bool has_new_ = false;       // objects were added since the last update
    bool interrupted_ = false;   // something has begun and not ended: what was derived from positions may be wrong
    std::size_t trim_below_ = 0; // number of objects at which memory may be given back

    // Results of stages; empty between updates.
    Batch batch_;                           // to be predicted
    std::vector<SweptProxy> swept_;         // the same, predicted
    std::vector<CandidatePair> candidates_; // may meet within their horizons
    std::vector<NearPair> found_near_;      // may be near now
};

template <typename Probe, typename Visit> void Broadphase::walk(const Probe &probe, Visit visit) const
{
    if (!sweeping_.finds_pairs())
    {
        index_.walk(probe, visit);
        return;
    }
    // Waiting objects are in the index with stale envelopes, or not at all.
    index_.walk(probe, [&](ProxyId id) {
        if (!sweeping_.waits(id))
            visit(id);
    });
    const IdSet &unpredicted = mode() == Mode::sweeping ? proxies_.members() : sweeping_.waiting();
    unpredicted.for_each([&](ProxyId id) {
        if (probe.overlaps(boxes_[id].outer()))
            visit(id);
    });
}
} // namespace ode_predictive_space

#endif
