// Second stage of the tick: a new path and envelope for each object of the batch, and how long and how closely to trust them.
//
// In: the batch, and what the scene shows of its objects. Out: paths, envelopes, horizons and new generations in the proxy
// store.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_PREDICTOR_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_PREDICTOR_H

#include <array>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/base/batch.h"
#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/prediction/history.h"
#include "ode_predictive_space/prediction/step_estimate.h"

namespace ode_predictive_space
{
/// Horizons in ticks.
struct HorizonBounds
{
    std::uint32_t min_ticks = 1;
    std::uint32_t max_ticks = 2048;
};

/// What a program may fix. Changed settings hold for later predictions.
struct PredictionSettings
{
    HorizonBounds horizon;

    /// Deviations of objects of the environment and of interactive ones; none: they adapt.
    std::array<std::optional<Deviation>, 2> deviation;
};

class Predictor
{
public:
    PredictionSettings settings;

    /// How far velocities carry objects in a tick, as far as is known.
    StepEstimate step_estimate;

    void resize(std::size_t count);

    /// Has the object predicted in the next update, whether or not it moves.
    void request(ProxyId id)
    {
        requested_.insert(id);
        has_requests_ = true;
    }
    void request(const IdSet &ids)
    {
        requested_ |= ids;
        has_requests_ = true;
    }
    bool has_requests() const { return has_requests_; }
    /// Moves all requests into the batch.
    void take_requests(Batch &batch);

    /// Makes a new prediction, from `now` on, for each object of the batch.
    ///
    /// @param near objects in near pairs: tight bounds may pay for them.
    void predict(Scene &scene, ProxyStore &proxies, const Batch &batch, const IdSet &near, Tick now);

    /// The same for one object that was observed. Raises its generation. The old prediction, if there is one, tells how well
    /// the object keeps to its predictions.
    void predict(ProxyStore &proxies, ProxyId id, const Observation &seen, Tick now);

    /// Are there interactive objects whose positions are sampled between predictions?
    bool samples() const { return sampled_count_ > 0; }
    /// Samples where they are.
    void sample_moved(Scene &scene, const ProxyStore &proxies, const IdSet &moved, Tick now);

    /// The same for one object.
    void sample(const ProxyStore &proxies, ProxyId id, const Vector3 &centre, Tick now);

    /// The object got a near pair. If it will stay among others for long it is worth tight bounds: its next prediction, which
    /// is then due at once, has them.
    void note_neighbour(ProxyStore &proxies, ProxyId id);

    /// The program has fixed the object's role: predicts it anew.
    void set_role(ProxyStore &proxies, ProxyId id, Role role);

    /// The horizon settings have changed: predicts all objects anew.
    void settings_changed(ProxyStore &proxies);

    /// Forgets how an object was predicted, but not what was learned about it.
    void forget_prediction(ProxyStore &proxies, ProxyId id);
    /// The same of all objects.
    void forget_predictions(ProxyStore &proxies);
    /// Forgets where objects have been, and gives the memory back.
    void forget_histories(ProxyStore &proxies);
    /// Forgets all about an object that is removed.
    void forget(ProxyStore &proxies, ProxyId id);

    /// Objects predicted to move: they are verified although no move is reported, for they may have stopped.
    const IdSet &moving() const { return moving_; }

    std::size_t bytes() const;

private:
    struct Outcome;
    struct Motion;

    Outcome judge(const ProxyStore &proxies, ProxyId id, const Vector3 &centre, Tick now) const;
    Motion motion_of_body(ProxyRecord &record, const Outcome &outcome, const Vector3 &velocity);
    Motion motion_from_history(ProxyRecord &record, const Outcome &outcome, const Vector3 &centre, Tick now);
    Motion estimate_motion(ProxyRecord &record, const Outcome &outcome, const Observation &seen, const Vector3 &centre,
                           Tick now);
    void adapt(ProxyRecord &record, const Outcome &outcome, double speed, double size) const;
    Deviation allow(const ProxyRecord &record, const Outcome &outcome, double size) const;
    std::uint32_t horizon_for(const ProxyRecord &record, const Motion &motion, double size) const;
    History &history_of(ProxyRecord &record);
    void note_prediction(const ProxyStore &proxies, ProxyId id);
    void set_sampled(ProxyId id, bool wanted);

    IdSet requested_;           // to be predicted in the next update
    bool has_requests_ = false; // some, maybe of objects that are gone
    IdSet moving_;
    IdSet sampled_; // interactive objects whose positions are remembered at each tick
    std::size_t sampled_count_ = 0;
    std::vector<History> histories_;
    std::vector<std::uint32_t> free_histories_;
    std::vector<Observation> seen_; // scratch
};
} // namespace ode_predictive_space

#endif
