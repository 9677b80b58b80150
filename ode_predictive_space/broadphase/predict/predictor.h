// Predicts a path and an envelope for each object of a batch. In: tight boxes and observations. Out: envelopes and records.
// The path is of second degree; the deviation from it grows with time (the paper, sections 3 and 4). The envelope is the box
// that both sweep until the path has covered the object's reach, or to the end of the horizon.

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
struct HorizonBounds
{
    std::uint32_t min_ticks = 1;
    std::uint32_t max_ticks = 2048;
};

struct PredictionSettings
{
    HorizonBounds horizon;

    /// Deviations of environment and of interactive objects; they adapt if none.
    std::array<std::optional<Deviation>, 2> deviation;
};

struct Forecast
{
    Envelope envelope; ///< from now on, without rotation
    double ticks;      ///< infinite if the object is still, 0 if its motion is unknown
    bool about_centre; ///< the sphere of the envelope's radius around its path holds the object in any orientation
    double turning;    ///< upper bound of the displacement of a point by rotation, per tick

    bool known() const { return ticks > 0; }
    bool still() const { return ticks == std::numeric_limits<double>::infinity(); }

    /// Two envelopes that hold the object as it turns. The first is tighter at the beginning, the second later.
    Envelope turning_on() const;
    Envelope turned_anyhow() const;
};

class Predictor
{
public:
    PredictionSettings settings;

    /// @pre the tight boxes of the batch are up to date.
    void predict(Scene &scene, ProxyStore &proxies, const Origin &origin, const std::vector<ProxyId> &batch, Tick now);

    /// Samples the objects of forecast queries. Called at the beginning of each tick.
    void sample(Scene &scene, const ProxyStore &proxies, Tick now) { samples_.sample(scene, proxies, now); }

    /// Counts a pair that is being dropped in the records of both objects: as useless if its tight boxes are apart.
    static void note_tests(ProxyStore &proxies, const CandidatePair &pair);

    /// The predicted motion of an object, whose poses are sampled from the first call on.
    Forecast forecast(Scene &scene, const ProxyStore &proxies, ProxyId id, const QueryTime &now);

    /// Upper bound of all finite coordinates of tight boxes: the largest one since the review before the last began.
    float farthest() const { return max(farthest_, reviewed_.farthest).largest_of_three(); }

    /// Reviews a part of the objects, so that farthest() can decrease. Called at the end of each tick.
    /// @return at the end of a review, the middle of all finite envelopes, if the origin should move there.
    std::optional<Vector3> review(const ProxyStore &proxies);
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
    float ticks_for(float distance, float speed, float acceleration) const;
    Deviation deviation_of(const ProxyRecord &record, const Deviation &adapted) const;
    static TightBox swept(const TightBox &box, const Motion &motion, float ticks, float deviation);
    void note_farthest(const TightBox &box);
    void follow(const Track &track, const ProxyRecord &record, Forecast &forecast) const;

    StepEstimate step_estimate_;
    // The result for objects below `end`, and for all that were predicted meanwhile.
    struct Reviewed
    {
        std::size_t end = 0;
        Float4 farthest = Float4::all(0);                                              // by coordinate
        Float4 low = Float4::all(std::numeric_limits<float>::infinity()), high = -low; // around all finite envelopes
        float sizes = 0, count = 0; // sum of all sides, and number, of finite envelopes

        void add(const TightBox &envelope);

        std::optional<Vector3> far_middle() const;
    };
    Float4 farthest_ = Float4::all(0); // result of the last review
    Reviewed reviewed_;
    bool is_reviewed_ = false; // the first review takes one tick
    Samples samples_;
    std::array<ProxyId, tuning::objects_per_call> ids_; // scratch
    std::vector<Observation> seen_;                     // scratch
};
} // namespace ode_predictive_space

#endif
