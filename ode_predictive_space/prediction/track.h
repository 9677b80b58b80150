// The motion of an object, derived from its last poses, one per tick.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_TRACK_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_TRACK_H

#include <array>
#include <cstdint>

#include "ode_predictive_space/prediction/deviation.h"
#include "ode_predictive_space/prediction/history.h"

namespace ode_predictive_space
{
/// Where an object is, and how it is turned.
struct SampledPose
{
    Vector3 pivot;            ///< the point that the object turns about
    Eigen::Matrix3d rotation; ///< always the same when turning changes nothing of the object
    double rounding;          ///< a bound of the rounding error of a coordinate of the pivot
    bool is_rigid;            ///< a later pose moves all points of the object with the pivot
};

/// Consecutive poses of one motion: per tick, the pivot is a polynomial of second degree, and the turning is constant.
///
/// Three poses determine such a motion. A fourth that does not agree with them begins another motion.
class Track
{
public:
    static constexpr int needed = 3;

    /// Adds the pose of a tick, in which the object has moved. A second pose of the same tick replaces the first; after a gap a new
    /// motion begins.
    void add(std::uint32_t tick, const SampledPose &pose);

    /// The object has not moved since the last pose.
    void repeat(std::uint32_t tick) { append(tick, {history_.before_newest(0), rotations_[0], rounding_, true}); }

    bool has_begun() const { return history_.count() > 0; }
    bool is_known() const { return history_.count() >= needed; }
    /// Are the last poses equal? Then the object rests.
    bool rests() const;

    /// The path through the last three positions; its time 0 is the time of the newest.
    Path path() const;
    /// The path that fits all positions of the motion best, up to eight.
    Path fitted() const { return history_.fit().path; }

    /// How far rounding may put the object off path(), beside its newest position.
    Deviation rounding() const;

    /// How far the end of a lever of length 1 moves in a tick by turning, at most.
    double turning() const;

private:
    void append(std::uint32_t tick, const SampledPose &pose);
    bool continues() const;

    History history_;
    double rounding_ = 0;
    std::array<Eigen::Matrix3d, needed> rotations_; // the newest first
};
} // namespace ode_predictive_space

#endif
