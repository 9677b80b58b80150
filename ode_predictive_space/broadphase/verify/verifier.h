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
        std::size_t moves;     ///< number of objects that have moved
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
    ///     bool has_centre()             the same, and it turns about its position: that is still the centre of its sphere
    ///     const Real *coordinates()     of the centre, if it has one
    ///     bool has_grown(float radius)  the object no longer fits into a sphere of this radius
    ///     std::uint32_t pose_digest()   another number, most of the time, for another pose
    ///     bool remember(ProxyId)        keeps pose and sizes for the next report; false when that is not possible
    ///     bool is_as_remembered(ProxyId) pose and sizes are those that were kept
    ///     bool is_watched()             it is worth while to compare poses now
    /// @return false when nothing has changed since the last report: that is no move.
    template <typename Object> bool report_move(ProxyStore &proxies, ProxyId id, const Object &object, Tick expected)
    {
        return report_at_once(proxies, id, object, expected) || report_closely(proxies, id, object, expected);
    }

    /// The first half of report_move(), which deals with nearly all reports: true when it has.
    template <typename Object> bool report_at_once(ProxyStore &proxies, ProxyId id, const Object &object, Tick expected)
    {
        Stamp &stamp = proxies.stamps[id];
        if (std::signbit(stamp.radius) || !object.has_centre())
        {
            if (object.is_watched() ? stamp.radius != Stamp::unpredicted : stamp.is_kept())
                return false;
            stamp.pose = 0;
            return note_in_doubt(id);
        }
        // ODE sends one notification per change. So when the pose has changed, the size has not.
        const std::uint32_t last = stamp.pose, pose = object.pose_digest();
        if (pose == last || last == 0)
            return false;
        stamp.pose = pose;
        if (!centre_inside(proxies.paths[id], object.coordinates(), expected))
            return note_in_doubt(id);
        board_.note(id);
        return true;
    }

    /// The second half: the report of an object that has no centre to be checked, whose size may have changed, or nothing at
    /// all.
    ///
    /// Programs set poses that do not change. When the digest of a pose comes again, pose and sizes are kept; they are compared
    /// with those of the next report.
    template <typename Object> bool report_closely(ProxyStore &proxies, ProxyId id, const Object &object, Tick expected)
    {
        Stamp &stamp = proxies.stamps[id];
        const std::uint32_t pose = object.has_pose() ? object.pose_digest() : 0;
        const bool repeated = stamp.may_be(pose);
        if (repeated && stamp.is_kept() && object.is_as_remembered(id))
            return false;
        const bool by_centre = proxies.records[id].kind.check == Check::centre && object.has_centre();
        stamp.set(pose, by_centre, repeated && object.remember(id));
        board_.note(id);
        if (!by_centre || !centre_inside(proxies.paths[id], object.coordinates(), expected) ||
            object.has_grown(std::abs(stamp.radius)))
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
    bool note_in_doubt(ProxyId id)
    {
        board_.note(id);
        doubtful_.insert(id);
        return true;
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
