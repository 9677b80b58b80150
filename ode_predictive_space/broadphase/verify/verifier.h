// First stage of the tick: which objects have left their envelopes?
//
// In: reports of moves, and where the objects are. Out: a batch of objects whose predictions broke. Most of the work is done
// when a move is reported and the object has just been written: a centre within its deviation needs no further look.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_VERIFIER_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_VERIFIER_H

#include <cmath>
#include <vector>

#include "ode_predictive_space/broadphase/base/batch.h"
#include "ode_predictive_space/broadphase/objects/measured_boxes.h"
#include "ode_predictive_space/broadphase/verify/checks.h"
#include "ode_predictive_space/broadphase/verify/notice_board.h"

namespace ode_predictive_space
{
class Verifier
{
public:
    /// What a verification found.
    struct Outcome
    {
        std::size_t verified = 0; ///< objects that moved, or were predicted to move and did not
        std::size_t broken = 0;   ///< those of them that have left their envelopes
    };

    /// What else decides which objects need a look.
    struct Circumstances
    {
        Tick now;
        bool time_passed;      ///< since the last verification
        bool as_expected;      ///< `now` is the tick by which reported moves were judged
        const IdSet &moving;   ///< predicted to move
        const IdSet &excluded; ///< objects that need no verification, because they wait for a prediction
    };

    void resize(std::size_t count);

    /// The position, size or anything else about the bounds of an object may just have changed. The last report of several
    /// judges the object's state at the next update.
    ///
    /// @param expected the tick of the next update, as far as is known.
    /// @tparam Object tells of the object:
    ///     bool has_pose()               its bounds follow from a pose that need not be computed first, and from its sizes
    ///     std::uint32_t pose_digest()   another number, most of the time, for another pose
    ///     bool remember()               keeps pose and sizes for the next report; false when that is not possible
    ///     bool is_as_remembered()       pose and sizes are those that were kept
    ///     bool has_centre()             it turns about its position: that is still the centre of the sphere that held it
    ///     const Real *coordinates()     of the centre, if it has pose and centre
    ///     bool has_grown(float radius)  the object no longer fits into a sphere of this radius
    /// @return false when nothing has changed since the last report: that is no move.
    template <typename Object> bool report_move(ProxyStore &proxies, ProxyId id, const Object &object, Tick expected)
    {
        Stamp &stamp = proxies.stamps[id];
        const std::uint32_t last = stamp.pose;
        stamp.pose = object.has_pose() ? (object.pose_digest() & ~pose_remembered) | pose_known : 0;
        const bool same_digest = (last & ~pose_remembered) == stamp.pose && stamp.pose != 0;
        if (same_digest && repeats(stamp, last, object))
            return false;
        board_.note(id);
        if (!as_predicted(proxies, id, object, expected, last == 0 || same_digest))
            doubtful_.insert(id);
        return true;
    }

    /// The object may have changed in any way since it was looked at.
    void mark_moved(ProxyId id)
    {
        moved_.insert(id);
        doubtful_.insert(id);
    }

    void forget(ProxyId id);

    /// Objects that have moved since the last update; collects the reports first.
    const IdSet &collect_moves()
    {
        board_.drain_into(moved_);
        return moved_;
    }

    const IdSet &moved() const { return moved_; }

    /// Adds to the batch each object that has left its envelope, has none, or has stopped.
    Outcome find_broken(Scene &scene, const ProxyStore &proxies, MeasuredBoxes &boxes, const Circumstances &now,
                        Batch &batch);

    /// Ends the update: all moves have been dealt with.
    void clear_moves()
    {
        moved_.clear();
        doubtful_.clear();
    }

    std::size_t bytes() const;

private:
    /// Programs set poses that did not change: pose and sizes are kept when the digest of the pose comes again, and compared
    /// from the next time on.
    template <typename Object>
    [[gnu::noinline]] static bool repeats(Stamp &stamp, std::uint32_t last, const Object &object)
    {
        const bool repeated = (last & pose_remembered) != 0 && object.is_as_remembered();
        if (repeated || object.remember())
            stamp.pose |= pose_remembered;
        return repeated;
    }

    /// Is the centre where it should be at the tick `then`? False means that it takes a closer look: for objects that are
    /// checked by their bounds, and for those whose position has to be computed first.
    ///
    /// ODE sends one notification per change. So the size has to be looked at only when the pose may be the one that the last
    /// notification found.
    template <typename Object>
    static bool as_predicted(const ProxyStore &proxies, ProxyId id, const Object &object, Tick then,
                             bool size_may_differ)
    {
        const Stamp &stamp = proxies.stamps[id];
        if (std::signbit(stamp.radius) || stamp.pose == 0 || !object.has_centre())
            return false;
        return centre_inside(proxies.paths[id], object.coordinates(), then) &&
               (!size_may_differ || !object.has_grown(stamp.radius));
    }

    std::size_t collect_suspects(const Circumstances &now);
    void look_at_suspects(Scene &scene, const ProxyStore &proxies, MeasuredBoxes &boxes);

    NoticeBoard board_; // moves reported since the last update
    IdSet moved_;       // since the last update
    IdSet doubtful_;    // those of them that were already off the predicted path when the move was reported
    IdList suspects_, by_bounds_, by_centre_; // scratch
    std::vector<Location> locations_;         // of by_centre_
};

/// Is the object inside its envelope?
///
/// @param location where its centre is; read for Check::centre alone.
bool prediction_holds(Scene &scene, const ProxyStore &proxies, const MeasuredBoxes &boxes, const Location &location,
                      ProxyId id, Tick now);
} // namespace ode_predictive_space

#endif
