// The broad phase with predictive scheduling: the tick and what it keeps.
//
//     moved objects -> verify -> re-predict -> envelope index -> time of proximity -> schedule -> wake -> near set
//
// Invariant: at each tick, after verification, every object lies inside its envelope. Therefore a pair whose envelopes are
// apart at this tick is apart, and every pair whose bounding boxes overlap is in the near set.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BROADPHASE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BROADPHASE_H

#include <vector>

#include "ode_predictive_space/broadphase/assess.h"
#include "ode_predictive_space/broadphase/envelope_index.h"
#include "ode_predictive_space/broadphase/event_wheel.h"
#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/measured_box.h"
#include "ode_predictive_space/broadphase/near_set.h"
#include "ode_predictive_space/broadphase/notice_board.h"
#include "ode_predictive_space/broadphase/predictor.h"
#include "ode_predictive_space/broadphase/prefetch.h"
#include "ode_predictive_space/broadphase/proxy_store.h"
#include "ode_predictive_space/broadphase/scan_policy.h"
#include "ode_predictive_space/broadphase/scouts.h"
#include "ode_predictive_space/broadphase/sweep.h"
#include "ode_predictive_space/broadphase/verify.h"

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
    std::uint64_t scans = 0;
};

/// The broad phase. It knows objects by number only; a Scene, given with each call, tells where they are:
///
///     Vector3 position(ProxyId)               centre, of those that are checked by it
///     const Real *coordinates(ProxyId)        the same, or null when no sphere around it holds the object however it turns
///     bool has_grown(ProxyId, float radius)   no longer fits into the sphere around its centre
///     void prefetch(ProxyId), void prefetch_pose(ProxyId)   the bounds will soon be asked for; the latter after the former
///     void prefetch_velocity(ProxyId)         it will soon be observed; after prefetch()
///     Box bounds(ProxyId)                     bounding box
///     void measure(ProxyId, MeasuredBox &)    the same
///     std::optional<Vector3> pivot(ProxyId)   what it turns around: finite, or none when that is not known
///     Observation observe(ProxyId, bool with_bounds)
///     bool overlap(ProxyId, ProxyId)          their bounding boxes do; by the measure of sphere, the spheres too
class Broadphase
{
public:
    Broadphase();

    Predictor predictor;

    Proximity measure() const { return measure_; }
    void set_measure(Proximity measure);

    /// A new object; it counts as moved.
    ProxyId add();
    void remove(ProxyId id);

    /// The object's position, size or anything else about its bounds has changed, just now; every such change must be told.
    ///
    /// @param object tells of it:
    ///     bool has_centre()                its centre need not be computed first, and is still that of the sphere which
    ///                                      held it however it turned, if there was one when it was predicted
    ///     const Real *coordinates()        of the centre, if it has one
    ///     bool has_grown(float radius)     it no longer fits into the sphere
    ///     std::uint32_t pose_digest()      another number, most of the time, when coordinates or rotation are others
    template <typename Object> void notice_move(ProxyId id, const Object &object)
    {
        noticed_.note(id);
        if (!notice_holds(proxies_, id, object, next_tick_))
            doubtful_.insert(id);
    }

    /// The object may have changed in any way since it was looked at.
    void mark_moved(ProxyId id)
    {
        moved_.insert(id);
        doubtful_.insert(id);
    }

    /// One tick: brings predictions and near set up to date. Time passes only when something has moved.
    template <typename Scene> void tick(Scene &scene) { update(scene, true); }

    /// The same without a tick: for questions between ticks.
    template <typename Scene> void catch_up(Scene &scene) { update(scene, false); }

    /// Tests the near set on the objects' bounds as they are now.
    ///
    /// @param room is where the pairs that overlap are written, from its beginning on. It grows if need be and never shrinks;
    ///     what is behind the pairs means nothing.
    /// @return their number.
    template <typename Scene> std::size_t report(Scene &scene, std::vector<CandidatePair> &room);

    /// Calls visit(id) for every object whose bounds may overlap `box`; the broad phase must be caught up.
    template <typename Visit> void query(const FloatBox &box, Visit visit) const { walk(BoxProbe(box), visit); }

    /// The same for a probe of any shape; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const;

    /// Fixes an object's role; its next prediction, at the next tick, follows it.
    void set_role(ProxyId id, Role role);

    /// Makes new predictions for all objects at the next tick, for when settings have changed.
    void predict_all_anew();

    /// Makes predictions at the next update, if there are none yet because most objects are new: for questions about them.
    ///
    /// @return true when there will be new ones.
    bool want_predictions();

    /// Makes predictions at the next update for all that have none, however many these are.
    void predict_the_rest();

    /// When two objects may be near, in ticks from now on; none when they stay apart over their horizons.
    std::optional<ProximityInterval> proximity(ProxyId first, ProxyId second) const
    {
        return ode_predictive_space::proximity(proxies_, first, second, now_, measure_);
    }

    const ProxyStore &proxies() const { return proxies_; }
    /// How many pairs are tested at each tick; stale ones among them. Pairs in the near set that rest are not.
    std::size_t tested_pairs() const { return scanning() ? scanned_.size() : near_.pairs().size(); }

    /// Calls visit(pair, verdict) for each pair in the near set that is not stale, whether it is tested at each tick or rests.
    template <typename Visit> void each_near(Visit visit) const
    {
        if (scanning())
            for_scanned([&](const CandidatePair &pair) { visit(pair, NearSet::Verdict::open); });
        else
            near_.for_all(visit);
    }

    const Counters &counters() const { return counters_; }

    /// Pairs that sleep until their time of proximity.
    std::size_t scheduled_pairs() const;
    /// Pairs in the near set.
    std::size_t near_pairs() const;

    Tick now() const { return now_; }
    /// Are the pairs found by looking at all objects, because not all are predicted?
    bool scanning() const { return policy_.scanning() || waiting_count_ > 0; }
    /// Has the object a path and an envelope? Not all have while the scene is scanned.
    bool predicted(ProxyId id) const { return proxies_.bounds[id].check != Check::none; }
    bool consistent() const { return index_.consistent(); }
    std::size_t bytes() const;

private:
    bool current(const Event &event) const;

    template <typename Scene> void update(Scene &scene, bool is_tick);
    template <typename Scene> bool calm_returns(Scene &scene, bool time_passes);
    template <typename Scene> void verify(Scene &scene, bool time_passes, bool as_expected);
    template <typename Scene> void renew(Scene &scene);
    template <typename Scene> bool holds(Scene &scene, ProxyId id);
    bool has_stopped(ProxyId id) const;
    template <typename Scene>
    void prefetch_bounds(const Scene &scene, const std::vector<ProxyId> &ids, std::size_t i) const;
    template <typename Scene> void prefetch_motion(const Scene &scene, std::size_t i) const;
    template <typename Scene> void prefetch_first_motions(const Scene &scene) const;
    bool overflows_cache() const { return objects() > cached_objects; }

    bool boxes_overflow_cache() const { return objects() > cached_boxes; }

    // Fetches what the test of a pair reads.
    auto box_fetcher() const
    {
        return [this](const CandidatePair &pair) {
            prefetch(&boxes_[pair.first]);
            prefetch(&boxes_[pair.second]);
        };
    }

    template <typename Scene> void remember(Scene &scene, ProxyId id);
    template <typename Scene> void predict(Scene &scene);
    template <typename Scene> void scan(Scene &scene);
    template <typename Scene> void sweep_all(Scene &scene);
    template <typename Scene> void measure_all(Scene &scene, const IdSet &wanted);
    template <typename Visit> Visit for_scanned(Visit visit) const;
    template <typename Visit> Visit visit_tested(Visit visit);
    template <typename Scene> struct OverlapTest;
    template <typename Scene> std::size_t test_near(Scene &scene, std::vector<CandidatePair> &room);
    template <typename Scene> void let_rest(Scene &scene);
    void take_note_of_moves();

    std::size_t objects() const { return objects_; }
    bool time_passes(bool is_tick);
    bool most_moving_have_moved() const;
    void collect_suspects(bool time_passes, bool as_expected);
    void advance_clock();
    void gather_predictions();
    void expire();
    void add_to_batch(ProxyId id);
    void sample(ProxyId id, bool wanted);
    void find_pairs(std::size_t single);
    void schedule();
    void wake();
    void add_near(const NearPair &pair);
    void note_crowded(const NearPair &pair);
    bool lingers(ProxyId id) const;
    void finish_update();
    bool mostly_new() const { return !predictions_wanted_ && 2 * (unpredicted_ - waiting_count_) > objects(); }
    std::size_t part() const { return std::max(least_part, objects() / parts); }
    std::size_t most_at_once() const
    {
        constexpr std::size_t small = EnvelopeIndex::small_scene; // predicted as a whole
        return objects() <= small ? small : std::max(least_at_once, objects() / 16);
    }
    bool is_waiting(ProxyId id) const { return waiting_count_ > 0 && waiting_.contains(id); }
    bool stop_waiting(ProxyId id);
    void postpone_batch();
    void add_part();
    void finish_parts();
    void start_scanning();
    void stop_scanning();
    void release_scan();
    void purge_stale_events();

    Proximity measure_ = Proximity::box;
    ProxyStore proxies_;
    std::vector<ProxyId> free_ids_;
    std::size_t objects_ = 0; // members
    IdSet members_;
    NoticeBoard noticed_; // moves since the last update, which begins with putting them into moved_
    IdSet moved_;         // since the last update
    IdSet doubtful_;      // those of them that were not found, when the move was noticed, where they should be
    IdSet moving_;        // predicted to move: verified although nobody reports them, for they may have stopped
    IdSet in_batch_;      // members of batch_
    IdSet interactive_;   // remembered at each tick
    IdSet measured_;      // have not moved since their bounds were last looked at
    IdSet due_anew_;      // to be predicted anew at the next update, whether or not they move
    IdSet waiting_;       // to be predicted when it is their turn; until then all are swept
    IdSet stirred_;       // have moved since pairs were last let rest
    Tick now_ = 0;
    Tick next_tick_ = 1; // that of the next update, probably: noticed moves are judged by where objects should be then
    bool ticked_early_ = false; // time has already passed since the last tick, in a catch_up()

    EnvelopeIndex index_;
    EventWheel wheel_;
    NearSet near_;
    ScanPolicy policy_;
    Scouts scouts_;
    Sweep sweep_;
    std::vector<MeasuredBox> boxes_; // the bounds of each object, where measured_
    Counters counters_;

    // Objects that are recognised as interactive are remembered at each tick while they are few; a hand is, a crowd is not.
    static constexpr std::size_t most_sampled = 64;
    std::size_t sampled_ = 0;

    static constexpr Tick ticks_per_count = 64; // of predictions, to know how many ticks' are made at once
    std::uint64_t counted_predictions_ = 0;     // before the last such count

    bool predictions_wanted_ = false;
    std::size_t unpredicted_ = 0; // members without a prediction

    // Predicting all objects takes as long as several sweeps over them: it is done in so many parts, unless these would be
    // small, while all are swept.
    static constexpr std::size_t parts = 16;
    static constexpr std::size_t least_part = 64;
    static constexpr std::size_t least_at_once = 64;
    std::size_t waiting_count_ = 0;      // of waiting_: asked for several times a tick, also where nobody waits
    bool parts_joined_ = false;          // all have been predicted, part by part, at the last update
    std::vector<ProxyId> queue_;         // in which they are predicted, from the last one on; of others, too
    std::vector<CandidatePair> scanned_; // all pairs that the last sweep over all objects found

    unsigned reports_ = 0; // so far, to know which of them is to let pairs rest

    static constexpr std::size_t least_purge = 4096;
    std::size_t purge_events_at_ = least_purge;
    std::size_t broken_ = 0; // predictions that the last verification found broken

    // What one stage hands to the next; empty between updates.
    std::vector<ProxyId> suspects_; // to be looked at
    std::vector<ProxyId> batch_;    // to be predicted anew
    std::vector<SweptProxy> swept_; // the same, predicted
    std::vector<Event> due_;
    std::vector<CandidatePair> candidates_;
    std::vector<NearPair> found_near_;
    std::vector<ScheduledPair> scheduled_;
    std::vector<SweptProxy> items_;
};
} // namespace ode_predictive_space

#include "ode_predictive_space/broadphase/tick.h"

#endif
