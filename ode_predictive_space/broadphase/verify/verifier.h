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

    /// The position, size or anything else about the bounds of an object has just changed. The last report of several judges
    /// the object's state at the next update.
    ///
    /// @param expected the tick of the next update, as far as is known.
    /// @tparam Object tells of the object:
    ///     bool has_centre()             its centre need not be computed first, and is still that of the sphere that held the
    ///                                   object however it turned, if there was one when it was predicted
    ///     const Real *coordinates()     of the centre, if it has one
    ///     bool has_grown(float radius)  the object no longer fits into a sphere of this radius
    ///     std::uint32_t pose_digest()   another number, most of the time, for another pose
    template <typename Object> void report_move(ProxyStore &proxies, ProxyId id, const Object &object, Tick expected)
    {
        board_.note(id);
        if (!as_predicted(proxies, id, object, expected))
            doubtful_.insert(id);
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
    /// Is the centre where it should be at the tick `then`? False means that it takes a closer look: for objects that are
    /// checked by their bounds, and for those whose position has to be computed first.
    ///
    /// ODE sends one notification per change. So the size has to be looked at only when the pose is the one that the last
    /// notification found, or when that is not known.
    template <typename Object>
    static bool as_predicted(ProxyStore &proxies, ProxyId id, const Object &object, Tick then)
    {
        Stamp &stamp = proxies.stamps[id];
        if (std::signbit(stamp.radius) || !object.has_centre())
        {
            stamp.pose = 0;
            return false;
        }
        const std::uint32_t last = stamp.pose, pose = object.pose_digest();
        stamp.pose = pose;
        return centre_inside(proxies.paths[id], object.coordinates(), then) &&
               ((pose != last && last != 0) || !object.has_grown(stamp.radius));
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
