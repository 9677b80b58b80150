// The broad phase with predictive scheduling. In: numbered objects, and notices of moves. Out: at each tick, the near pairs.
//
//     notices -> measure -> predict -> index -> near set -> pairs
//
// Invariant: at each tick, after measure, every object lies inside its envelope. Therefore a pair whose envelopes are apart is
// apart, and every pair whose bounding boxes overlap is in the near set.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BROADPHASE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BROADPHASE_H

#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/base/batch.h"
#include "ode_predictive_space/broadphase/index/envelope_index.h"
#include "ode_predictive_space/broadphase/near/near_set.h"
#include "ode_predictive_space/broadphase/objects/measured_shapes.h"
#include "ode_predictive_space/broadphase/predict/predictor.h"

namespace ode_predictive_space
{
enum class ProximityTest
{
    box,    ///< bounding boxes overlap
    sphere, ///< bounding boxes and bounding spheres overlap
    shape   ///< bounding boxes overlap, and the shapes may touch or are unknown
};

struct Counters
{
    std::uint64_t moved = 0;
    std::uint64_t violations = 0;
    std::uint64_t repredictions = 0;
    std::uint64_t sweeps = 0;
    std::uint64_t gap_checks = 0;
};

/// Owns the stages of the tick, and passes the results of each to the next. After an exception in an update or report, the
/// derived state is discarded: the next update measures all objects, and is exact.
class Broadphase
{
public:
    // --- Objects ---

    /// Makes room for `more` objects, so that as many calls of add() throw nothing. On an exception no object has changed.
    void make_room(std::size_t more);
    /// Adds an object, which counts as moved.
    ProxyId add();
    /// Throws nothing.
    void remove(ProxyId id);

    /// Notice of a change of an object's pose, size or anything else that its bounds depend on. Every change needs one.
    /// @tparam Object describes the object:
    ///     bool has_pose()            the next two are known
    ///     const Real *position()
    ///     const Real *rotation()     three rows of four numbers
    ///     bool turns_safely()        the sphere of its radius around its position holds it after any rotation
    ///     Solid solid()
    ///     double radius()
    /// @return Followed::moved, in nearly all cases, when the notice is complete; otherwise notify_closely() must follow.
    template <typename Object> // inlined although it is large: it runs at each notice
    [[gnu::always_inline]] Followed notify_at_once(ProxyId id, const Object &object)
    {
        Place &place = proxies_.places[id];
        const Watch watch = place.watch();
        if (watch <= Watch::carried || !object.has_pose() || (watch == Watch::centre && !object.turns_safely()))
            return Followed::left;
        return noted(id, place, place.follow(object.position(), object.rotation(), origin_));
    }

    /// notify_at_once() for an object that is watched as carried and turns safely.
    Followed notify_carried_at_once(ProxyId id, Float4 centre)
    {
        Place &place = proxies_.places[id];
        return noted(id, place, place.follow_centre(centre));
    }

    /// @return false when pose and size are unchanged in single precision: that counts as no move.
    template <typename Object> bool notify_closely(ProxyId id, const Object &object, Followed followed);

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

    /// The report has found a disabled object in one of its pairs.
    void note_disabled(ProxyId id) { request(id); }

    // --- The tick ---

    /// One tick: brings envelopes and near set up to date. Time passes only when something has moved.
    void tick(Scene &scene) { update(scene, true); }

    /// Brings envelopes and index up to date for queries between ticks. The near set gets the new pairs later.
    void catch_up(Scene &scene)
    {
        update(scene, false);
        index_.prepare(proxies_);
    }
    /// Whether queries need no catch_up() if nothing has moved since the last tick.
    bool is_prepared() const { return !interrupted_ && index_.is_prepared(); }

    /// Catches up and brings the near set up to date, without a tick.
    void find_new_pairs(Scene &scene);

    /// Writes the pairs that pass the proximity test to the beginning of `room`, which grows as needed and never shrinks.
    /// @pre the broad phase is up to date. @return the number of pairs.
    std::size_t report(Scene &scene, std::vector<CandidatePair> &room);

    // --- Queries; the broad phase must be caught up ---

    /// Calls visit(id) for every object whose bounds may overlap the probe; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        index_.walk(probe, visit);
    }

    /// The predicted motion of an object. It is known after three sampled ticks; sampling begins with the first forecast query.
    /// @param collisions number of collisions so far; an object without a move for tuning::calls_of_a_habit of them is still.
    Forecast forecast(Scene &scene, ProxyId id, std::uint64_t collisions);

    /// The earliest time at which two objects may be near, in ticks from now; none if they stay apart in both forecasts.
    /// @param by_sphere near objects must have overlapping spheres, too.
    std::optional<double> time_of_proximity(const Forecast &first, const Forecast &second, bool by_sphere) const;

    /// Brings shapes up to date for time_of_contact() and may_touch(). @pre ProximityTest::shape.
    void follow_shapes(Scene &scene, const IdSet &wanted);

    /// The earliest time at which two shapes may touch, as above; 0 if they may now. @pre follow_shapes() of both.
    std::optional<double> time_of_contact(const Forecast &first, const Forecast &second,
                                          const CandidatePair &pair) const;

    bool may_touch(const CandidatePair &pair) const;

    // --- Settings ---

    ProximityTest proximity_test() const { return proximity_test_; }
    void set_proximity_test(ProximityTest test);

    double shape_margin() const { return shape_margin_; }
    /// The shape test reports pairs up to this distance apart. @param margin finite and not negative.
    void set_shape_margin(double margin);

    const PredictionSettings &settings() const { return predictor_.settings; }
    /// All objects are predicted with these settings at the next update.
    void set_settings(const PredictionSettings &settings);

    void set_role(ProxyId id, Role role);

    // --- State ---

    const ProxyStore &proxies() const { return proxies_; }
    const Counters &counters() const { return counters_; }
    Tick now() const { return clock_.now; }

    /// Sets the next update's number, so that tests reach the wrap-around. @pre nothing has moved since the last update.
    void number_updates_from(UpdateNumber next) { clock_.update = next; }

    /// Whether the object is known to be disabled. The near set has no pairs of such objects.
    bool idle(ProxyId id) const { return idle_.contains(id); }

    std::size_t near_pairs() const;
    std::size_t waiting_pairs() const { return near_.resting() + postponed_pairs(); }

    std::uint64_t woken_pairs() const { return near_.woken(); }

    template <typename Visit> void for_each_near_pair(Visit visit) const { near_.for_each(visit); }

    std::size_t postponed_pairs() const;

    /// Calls visit(pair) for each postponed pair, after bringing all shapes up to date. @pre the broad phase is up to date.
    template <typename Visit> void for_each_postponed(Scene &scene, Visit visit)
    {
        follow_shapes(scene, proxies_.members());
        near_.for_each_postponed(shapes_, visit);
    }

    /// The point to which coordinates of envelopes and tight boxes are relative. It moves when all objects are far from it.
    const Origin &origin() const { return origin_; }
    float farthest() const { return predictor_.farthest(); }

    bool consistent() const { return index_.consistent(); }
    std::size_t bytes() const;

private:
    void note_move(Place &place) { clock_.moves += place.note_move(clock_.update); }
    Followed noted(ProxyId id, Place &place, Followed followed)
    {
        // Only the pose has changed: ODE notifies a change of the size separately, with an unchanged pose.
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
    void request_enabled(Scene &scene);
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
    void request_all();
    void resize_stages();
    void trim();

    struct Clock
    {
        Tick now = 0;
        UpdateNumber update = 1;   // the next update, which will process moves noted now
        std::size_t moves = 0;     // objects that have moved since the last update
        std::size_t unticked = 0;  // objects that had moved in updates since the last tick
        std::uint32_t queries = 0; // updates after moves since the last tick
    };

    struct Listing
    {
        IdSet listed;                 // objects with a watched solid were measured by their last notice
        IdSet requested;              // listed objects that get new envelopes in any case
        bool any_doubtful = false;    // moves that may be too small for single precision
        std::vector<ProxyId> current; // scratch
    };

    // State between new envelopes and near pairs. Only `waiting` keeps members between updates.
    struct Pairing
    {
        IdSet waiting; // objects whose new pairs are not in the near set yet
        Batch batch;
        std::vector<CandidatePair> found;
    };

    Origin origin_;
    std::optional<Vector3> next_origin_; // applied by the next update
    ProxyStore proxies_;
    MeasuredShapes shapes_; // in use with ProximityTest::shape
    IdSet idle_;            // objects that were disabled when they got an envelope or were reported; in no near pair
    Predictor predictor_;
    EnvelopeIndex index_;
    NearSet near_;
    ProximityTest proximity_test_ = ProximityTest::box;
    double shape_margin_ = 0;
    Counters counters_;
    Clock clock_;
    Listing listing_;
    Batch batch_;
    Pairing pairing_;
    bool interrupted_ = false;   // an operation has not ended: the derived state may be wrong
    std::size_t trim_below_ = 0; // memory may be given back when fewer objects than this remain
};

template <typename Object> bool Broadphase::notify_closely(ProxyId id, const Object &object, Followed followed)
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
    // The move may be too small for single precision. It must keep pairs from coming to rest, and adds to travel.
    place.note_doubtful_move(clock_.update);
    listing_.any_doubtful = true;
    return false;
}
} // namespace ode_predictive_space

#endif
