// A new path and envelope for each object of a batch: where will it be, and how closely is that known?
//
// In: the batch, its tight boxes, and what the scene shows of its objects. Out: envelopes, and records of what they were made of.
//
// The path is of second degree, the deviation from it grows with time (the paper, sections 3 and 4). The envelope is the place
// that both sweep until the path has gone as far as the object's reach, or to the end of the horizon.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_PREDICTOR_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_PREDICTOR_H

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/broadphase/predict/samples.h"
#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/prediction/envelope.h"
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

/// A prediction that is asked for: an envelope that moves, and the ticks for which it is made.
struct Forecast
{
    Envelope envelope; ///< its time is counted from now on; of an object that does not turn
    double ticks;      ///< infinite when the object is still, 0 when its motion is not known
    bool about_centre; ///< the sphere of the envelope's radius around its path holds the object however it turns
    double turning;    ///< how far turning moves a point of the object in a tick, at most

    bool known() const { return ticks > 0; }
    bool still() const { return ticks == std::numeric_limits<double>::infinity(); }

    /// Two envelopes that hold the object as it turns: the first is the closer one soon, the second later.
    Envelope turning_on() const;
    Envelope turned_anyhow() const;
};

class Predictor
{
public:
    PredictionSettings settings;

    /// Makes a new prediction, from `now` on, for each object of the batch. Their tight boxes are up to date.
    void predict(Scene &scene, ProxyStore &proxies, const Origin &origin, const std::vector<ProxyId> &batch, Tick now);

    /// A tick has begun: samples the objects that the program asks about.
    void sample(Scene &scene, const ProxyStore &proxies, Tick now) { samples_.sample(scene, proxies, now); }

    /// Two objects were tested for some ticks, until one of them got a new prediction: learns from that.
    static void note_tests(ProxyStore &proxies, const CandidatePair &pair);

    /// How the object will move, as far as is known now. Its tight box is up to date. From now on its poses are sampled.
    Forecast forecast(Scene &scene, const ProxyStore &proxies, ProxyId id, const QueryTime &now);

    /// No finite side of an object is farther from the origin than this: the largest finite coordinate of an envelope, or of an
    /// object in it, since the review before the last began.
    float farthest() const { return max(farthest_, reviewed_.farthest).largest_of_three(); }

    /// A tick has ended: goes through a part of the objects, so that farthest() follows those that come back.
    ///
    /// @return when all have been seen and are so far from the origin that rounding shows in their boxes, their middle.
    std::optional<Vector3> review(const ProxyStore &proxies);
    /// All objects are counted from another origin, and predicted again.
    void forget_reviews();

    void forget(ProxyId id) { samples_.forget(id); }
    void release() { samples_ = {}; }
    std::size_t bytes() const { return samples_.bytes() + bytes_of(seen_); }

private:
    struct Motion;
    struct Outcome;

    bool leaps(ProxyStore &proxies, ProxyId id, Tick now);
    void predict(ProxyStore &proxies, const Origin &origin, ProxyId id, const Observation &seen, Tick now);
    Outcome judge(const ProxyRecord &record, Float4 centre, Tick now) const;
    Motion motion_of(ProxyRecord &record, const Outcome &outcome, const Observation &seen);
    Motion motion_of_body(const ProxyRecord &record, const Outcome &outcome, Float4 velocity);
    float ticks_for(float way, float speed, float acceleration) const;
    Deviation deviation_of(const ProxyRecord &record, const Deviation &adapted) const;
    static TightBox swept(const TightBox &box, const Motion &motion, float ticks, float deviation);
    void note_farthest(const TightBox &box);
    void follow(const Track &track, const ProxyRecord &record, Forecast &forecast) const;

    StepEstimate step_estimate_;
    // Objects below `end`, and what was predicted meanwhile.
    struct Reviewed
    {
        std::size_t end = 0;
        Float4 farthest = Float4::all(0);                                              // by coordinate
        Float4 low = Float4::all(std::numeric_limits<float>::infinity()), high = -low; // of finite envelopes
        float sizes = 0, count = 0;                                                    // of the same: sums of sides

        void add(const TightBox &envelope);

        std::optional<Vector3> far_middle() const;
    };
    Float4 farthest_ = Float4::all(0); // when the last review ended
    Reviewed reviewed_;
    bool is_reviewed_ = false; // the first review is made in one tick
    Samples samples_;
    std::array<ProxyId, tuning::objects_per_call> ids_; // scratch
    std::vector<Observation> seen_;                     // scratch
};
} // namespace ode_predictive_space

#endif
