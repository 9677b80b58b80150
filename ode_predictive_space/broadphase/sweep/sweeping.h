// The fallback: where prediction does not pay, all pairs are found by sort and sweep over all bounding boxes.
//
// In: members and their boxes. Out: the pairs whose boxes overlap, and which objects are predicted next.
//
//                       most objects are new, or predictions keep breaking
//       predicting ──────────────────────────────────────────────────────► sweeping
//         │   ▲                                                              │   │
//         │   │ all have been predicted                       calm is back   │   │ a question asks for
//         ▼   │                                                              │   │ predictions
//       filling ◄────────────────────────────────────────────────────────────┘   │
//                          predicting ◄───────────────────────────────────────────┘
//
//   predicting → filling: too many predictions broke in one tick.
//   filling → sweeping: predictions keep breaking.
//   any → sweeping: a tick was broken off by an exception.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_SWEEPING_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_SWEEPING_H

#include <vector>

#include "ode_predictive_space/broadphase/base/batch.h"
#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"
#include "ode_predictive_space/broadphase/near/overlap_test.h"
#include "ode_predictive_space/broadphase/sweep/motion_sampler.h"
#include "ode_predictive_space/broadphase/sweep/sweep_policy.h"

namespace ode_predictive_space
{
/// How pairs are found.
enum class Mode
{
    predicting, ///< all objects are predicted: the near set has the pairs
    filling, ///< some wait for their predictions, a part of the scene in each tick; until then a sweep finds the pairs
    sweeping ///< no object is predicted: a sweep finds the pairs
};

class Sweeping
{
public:
    Mode mode() const { return mode_; }
    /// Does a sweep find the pairs?
    bool finds_pairs() const { return mode_ != Mode::predicting; }

    void resize(std::size_t count) { waiting_.resize(count); }

    // --- Transitions ---

    /// A tick of prediction has passed.
    ///
    /// @return true when the scene is to be swept: start() is due.
    bool predictions_fail(std::size_t broken, std::size_t predicted)
    {
        return predicted > 0 && policy_.prediction_fails(broken, predicted);
    }

    /// Any mode → sweeping. All predictions have been forgotten.
    ///
    /// @param with_new_objects because most objects are new: any calm ends it.
    void start(const IdSet &members, bool with_new_objects);

    /// A tick of sweeping has passed: is the motion so calm that start_filling() is due?
    bool calm_returns(Scene &scene, const IdSet &members, StepEstimate &step)
    {
        return policy_.calm_returns(sampler_.is_calm(scene, members, step));
    }

    /// Sweeping → filling: all members wait.
    void start_filling(const IdSet &members, std::size_t count);

    /// Predicting → filling, or filling on: the object waits from now on.
    void wait(ProxyId id);

    /// The object will be predicted, or is gone.
    void stop_waiting(ProxyId id);

    /// Filling → predicting, unless objects wait.
    ///
    /// @param in_parts not all objects were predicted at once.
    void finish_filling(bool in_parts);

    /// Sweeping → predicting, if sweeping began because most objects were new and the program asks for predictions.
    ///
    /// @return true when it did; then all objects have to be predicted.
    bool end_for_predictions();

    /// Predictions are asked for: new objects are no reason to sweep any more.
    void want_predictions() { predictions_wanted_ = true; }

    // --- What is known of the objects ---

    /// Are so many new objects a reason to sweep? Only their velocities are known, and not even how far these carry them.
    bool mostly_new(std::size_t new_objects, std::size_t objects) const
    {
        return !predictions_wanted_ && mode_ != Mode::sweeping && 2 * new_objects > objects;
    }

    bool waits(ProxyId id) const { return waiting_count_ > 0 && waiting_.contains(id); }
    const IdSet &waiting() const { return waiting_; }
    std::size_t waiting_count() const { return waiting_count_; }

    /// Adds to the batch the next part of those that wait: neighbours, so that they make a good part of a tree. Idle objects,
    /// which are not swept, come first.
    void add_part(std::size_t objects, const IdSet &idle, Batch &batch);

    /// True once after the last part: a tree made of parts is worse than one that is built at once.
    bool take_parts_joined();
    bool parts_joined() const { return parts_joined_; }

    // --- Pairs ---

    /// Finds all pairs of members, but idle ones, whose boxes overlap. All boxes are up to date.
    void find_pairs(const IdSet &members, const IdSet &idle, const MeasuredBoxes &boxes);

    /// Pairs found, some of objects that are gone among them.
    std::size_t pairs() const { return pairs_.size(); }

    /// Writes those of the pairs that overlap to `room`, which has room for pairs().
    ///
    /// @return the end of what was written.
    CandidatePair *report(const OverlapTest &test, const IdSet &members, CandidatePair *room) const;

    /// Calls visit(pair) for each pair found of which neither object is gone.
    template <typename Visit> Visit for_each_pair(const IdSet &members, Visit visit) const
    {
        for (const CandidatePair &pair : pairs_)
            if (members.contains(pair.first) && members.contains(pair.second))
                visit(pair);
        return visit;
    }

    /// Gives the memory of the sweep back.
    void release();

    std::size_t bytes() const;

private:
    Mode mode_ = Mode::predicting;
    SweepPolicy policy_;
    MotionSampler sampler_;
    SortAndSweep sort_and_sweep_;
    bool with_new_objects_ = false;
    bool predictions_wanted_ = false;
    IdSet waiting_;
    std::size_t waiting_count_ = 0; // of waiting_
    bool parts_joined_ = false;     // all were predicted, part by part, in the last update
    std::vector<ProxyId> queue_;    // in which objects are predicted, from the last one on; others among them
    std::vector<SweptProxy> items_; // all members with their boxes
    std::vector<CandidatePair> pairs_;
};
} // namespace ode_predictive_space

#endif
