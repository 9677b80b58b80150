// The broad phase with predictive scheduling. In: objects by number, and notices of their moves. Out: at each tick, the pairs
// whose bounding boxes overlap.
//
//     notices -> measure -> predict -> index -> near set -> pairs
//
// Invariant: at each tick, after measure, every object lies inside its envelope. Therefore a pair whose envelopes are apart is apart,
// and every pair whose bounding boxes overlap is in the near set.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BROADPHASE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BROADPHASE_H

#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/base/batch.h"
#include "ode_predictive_space/broadphase/base/worklist.h"
#include "ode_predictive_space/broadphase/index/envelope_index.h"
#include "ode_predictive_space/broadphase/near/near_set.h"
#include "ode_predictive_space/broadphase/objects/idle_objects.h"
#include "ode_predictive_space/broadphase/predict/predictor.h"

namespace ode_predictive_space
{
/// When is a pair reported?
enum class ProximityTest
{
    box,    ///< when bounding boxes overlap
    sphere, ///< when bounding boxes and bounding spheres overlap
    shape   ///< when bounding boxes overlap, and the shapes, where they are known, may touch
};

/// What has been done so far; see dPredictiveSpaceStats.
struct Counters
{
    std::uint64_t moved = 0;
    std::uint64_t violations = 0;
    std::uint64_t repredictions = 0;
    std::uint64_t sweeps = 0;
    std::uint64_t gap_checks = 0; ///< between two shapes
};

/// Owns the stages of the tick, and hands the results of each to the next. No stage knows another.
///
/// When an exception leaves a function here, what was known is given up: the next update measures all objects, and is exact.
class Broadphase
{
public:
    // --- Objects ---

    /// Makes room for so many more objects, so that as many calls of add() throw nothing. On an exception no object has changed.
    void make_room(std::size_t more);
    /// A new object; it counts as moved.
    ProxyId add();
    /// Throws nothing.
    void remove(ProxyId id);

    /// The object's position, size or anything else about its bounds may have changed, just now. Every change must be reported.
    ///
    /// @tparam Object tells of the object:
    ///     bool has_pose()            the next two are known
    ///     const Real *position()
    ///     const Real *rotation()     three rows of four numbers
    ///     bool turns_safely()        the sphere of its radius around its position still holds it, however it has turned
    ///     Solid solid()
    ///     double radius()
    /// @return what is known at once; nearly always that the object has moved. Otherwise the rest is for report_closely().
    template <typename Object> // inlined although it is large: it runs at each notice
    [[gnu::always_inline]] Followed report_at_once(ProxyId id, const Object &object)
    {
        Place &place = proxies_.places[id];
        const Watch watch = place.watch();
        if (watch <= Watch::carried || !object.has_pose() || (watch == Watch::centre && !object.turns_safely()))
            return Followed::left;
        return noted(id, place, place.follow(object.position(), object.rotation(), origin_));
    }

    /// Does what report_at_once() does, for an object that is watched as carried and turns safely.
    Followed report_carried_at_once(ProxyId id, Float4 centre)
    {
        Place &place = proxies_.places[id];
        return noted(id, place, place.follow_centre(centre));
    }

    /// @return false when nothing has changed since the last report, as far as single precision tells: that counts as no move.
    template <typename Object> bool report_closely(ProxyId id, const Object &object, Followed followed);

    /// The object may have changed in any way since it was looked at.
    void mark_moved(ProxyId id)
    {
        note_move(proxies_.places[id]);
        list(id);
    }
    /// The object is made of other data.
    void mark_changed(ProxyId id)
    {
        shapes_.forget(id);
        mark_moved(id);
    }

    /// A pair of the object came up for report, and the object is disabled.
    void note_disabled(ProxyId id) { request(id); }

    // --- The tick ---

    /// One tick: brings envelopes and near set up to date. Time passes only when something has moved.
    void tick(Scene &scene) { update(scene, true); }

    /// For questions between ticks: brings envelopes and index up to date. New pairs are found when they are needed.
    void catch_up(Scene &scene)
    {
        update(scene, false);
        index_.prepare(proxies_);
    }
    /// Can questions be asked now, if nothing has moved since the last tick?
    bool is_prepared() const { return !interrupted_ && index_.is_prepared(); }

    /// Brings the near set up to date, too, without a tick.
    void find_new_pairs(Scene &scene);

    /// Finds the pairs that overlap now. The broad phase must be up to date.
    ///
    /// @param room where the pairs are written, from its beginning on. It grows as needed and never shrinks; elements behind
    ///     the pairs mean nothing.
    /// @return their number.
    std::size_t report(Scene &scene, std::vector<CandidatePair> &room);

    // --- Questions; the broad phase must be caught up ---

    /// Calls visit(id) for every object whose bounds may overlap the probe; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        index_.walk(probe, visit);
    }

    /// How the object will move, as far as is known now. Its motion is known from the third tick on, that before the first question
    /// included.
    ///
    /// @param collisions a count of the program's calls of tick(): an object that has not moved during two calls rests.
    Forecast forecast(Scene &scene, ProxyId id, std::uint64_t collisions);

    /// When two objects may be near, in ticks from now on; none when they stay apart as long as both forecasts hold.
    ///
    /// @param by_sphere they are near when their spheres overlap, too.
    std::optional<double> time_of_proximity(const Forecast &first, const Forecast &second, bool by_sphere) const;

    /// Brings the shapes of objects up to date for time_of_contact(). By the shape test only.
    void follow_shapes(Scene &scene, const IdSet &wanted);

    /// By the shape test: when the shapes of two objects may touch, in ticks from now on; 0 when they may now, none when they stay
    /// apart as long as both forecasts hold. Their shapes are up to date.
    std::optional<double> time_of_contact(const Forecast &first, const Forecast &second,
                                          const CandidatePair &pair) const;

    /// By the shape test: whether the shapes of two objects may touch now. Their shapes are up to date.
    bool may_touch(const CandidatePair &pair) const;

    // --- Settings ---

    ProximityTest proximity_test() const { return proximity_test_; }
    void set_proximity_test(ProximityTest test);

    double shape_margin() const { return shape_margin_; }
    /// By the shape test, pairs up to this distance are reported. @param margin finite and not negative.
    void set_shape_margin(double margin);

    const PredictionSettings &settings() const { return predictor_.settings; }
    /// All objects get new envelopes by these settings at the next tick.
    void set_settings(const PredictionSettings &settings);

    /// Fixes an object's role; its next prediction, at the next tick, follows it.
    void set_role(ProxyId id, Role role);

    // --- What it knows ---

    const ProxyStore &proxies() const { return proxies_; }
    const Counters &counters() const { return counters_; }
    Tick now() const { return clock_.now; }

    /// The next update gets this number, as if many updates had passed. For tests, which cannot wait for the numbers to be used again.
    ///
    /// @pre nothing has moved since the last update.
    void number_updates_from(UpdateNumber next) { clock_.update = next; }

    /// Is the object disabled, as far as was noticed? Its pairs are not in the near set.
    bool idle(ProxyId id) const { return idle_.contains(id); }

    /// Pairs that may overlap now, tested or at rest.
    std::size_t near_pairs() const;
    /// Of these, pairs that are not tested until one of their objects has moved, or moved far enough.
    std::size_t waiting_pairs() const { return near_.resting() + postponed_pairs(); }

    /// Pairs that were not tested for some time and are again.
    std::uint64_t woken_pairs() const { return near_.woken(); }

    /// Calls visit(pair, state) for each pair that may overlap now.
    template <typename Visit> void for_each_near_pair(Visit visit) const { near_.for_each(visit); }

    /// Pairs that are not tested because their shapes cannot touch yet.
    std::size_t postponed_pairs() const;

    /// Calls visit(pair) for each of these that cannot touch even now. The broad phase must be up to date.
    template <typename Visit> void for_each_postponed(Scene &scene, Visit visit)
    {
        follow_shapes(scene, proxies_.members());
        near_.for_each_postponed(shapes_, visit);
    }

    /// Coordinates of envelopes and tight boxes are relative to it. It moves when all objects are far from it.
    const Origin &origin() const { return origin_; }
    /// No finite side of an object is farther from the origin.
    float farthest() const { return predictor_.farthest(); }

    bool consistent() const { return index_.consistent(); }
    std::size_t bytes() const;

private:
    void note_move(Place &place) { clock_.moves += place.note_move(clock_.update); }
    Followed noted(ProxyId id, Place &place, Followed followed)
    {
        // Only the pose has changed: a change of the size has a separate notice, with an unchanged pose.
        if (followed == Followed::left_as_measured)
        {
            listing_.listed.insert(id);
            followed = Followed::moved;
        }
        if (followed == Followed::moved)
            note_move(place);
        return followed;
    }
    void list(ProxyId id)
    {
        proxies_.places[id].stop_watching();
        listing_.listed.insert(id);
    }
    void request(ProxyId id)
    {
        listing_.requested.insert(id);
        list(id);
    }

    void update(Scene &scene, bool is_tick);
    void measure_listed(Scene &scene);
    void predict(Scene &scene);
    void postpone_pairs();
    void find_pairs(Scene &scene);
    void find_pairs(Scene &scene, const Batch &batch);
    void make_tight(Scene &scene, const Batch &batch);
    void finish();
    void start_over();
    void review(Scene &scene);
    void move_origin(const Vector3 &origin);
    void forget(ProxyId id);
    /// When memory runs out in the step, the next update starts over.
    template <typename Step> void attempt(Step step);
    void request_all();
    void resize_stages();
    void trim();

    // What is known of time.
    struct Clock
    {
        Tick now = 0;
        UpdateNumber update = 1;   // that will see the moves that are noted now
        std::size_t moves = 0;     // objects that have moved since the last update
        std::size_t unticked = 0;  // objects that had moved in updates since the last tick
        std::uint32_t queries = 0; // updates after moves since the last tick
    };

    // What the next look is to see. Maybe some that are gone, or have hardly moved.
    struct Listing
    {
        Worklist listed;              // those whose solid is watched were measured by the last notice
        IdSet requested;              // of these, those that get new envelopes in any case
        std::vector<ProxyId> current; // scratch
    };

    // From new envelopes to near pairs. Empty between updates, but for `waiting`.
    struct Pairing
    {
        Worklist waiting; // have new envelopes: their pairs are not in the near set yet
        Batch batch;
        std::vector<CandidatePair> found;
    };

    Origin origin_;
    std::optional<Vector3> next_origin_; // for the next update
    ProxyStore proxies_;
    MeasuredShapes shapes_; // in use by the shape test
    IdleObjects idle_;
    Predictor predictor_;
    EnvelopeIndex index_;
    NearSet near_;
    ProximityTest proximity_test_ = ProximityTest::box;
    double shape_margin_ = 0;
    Counters counters_;
    Clock clock_;
    Listing listing_;
    Batch batch_; // get new envelopes in this update
    Pairing pairing_;
    bool interrupted_ = false;   // something has begun and not ended: what was derived from positions may be wrong
    std::size_t trim_below_ = 0; // number of objects at which memory may be given back
};

template <typename Object> bool Broadphase::report_closely(ProxyId id, const Object &object, Followed followed)
{
    Place &place = proxies_.places[id];
    const auto same_size = [&] {
        return place.watches_centre() ? object.radius() <= place.watched_radius() : place.solid() == object.solid();
    };
    const bool is_measured = followed == Followed::left && object.has_pose() && place.watches_solid();
    if (is_measured && is_finite(place.tight_lanes()) && same_size())
    {
        note_move(place);
        listing_.listed.insert(id);
        return true;
    }
    if (followed != Followed::same || !same_size())
    {
        mark_moved(id);
        return true;
    }
    // The object may have moved by less than single precision can express: its pairs must not come to rest, and by shape the move
    // adds to its travel.
    place.note_doubtful_move(clock_.update);
    listing_.listed.demand();
    return false;
}
} // namespace ode_predictive_space

#endif
