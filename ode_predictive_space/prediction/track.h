// The motion of an object, derived from its last poses, one per tick.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_TRACK_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_TRACK_H

#include <array>
#include <cstdint>

#include "ode_predictive_space/prediction/deviation.h"
#include "ode_predictive_space/prediction/history.h"

namespace ode_predictive_space
{
struct SampledPose
{
    Vector3 pivot;            ///< the point that the object turns about
    Eigen::Matrix3d rotation; ///< constant if the object is the same in all orientations
    double rounding;          ///< upper bound of the rounding error of a coordinate of the pivot
    bool is_rigid;            ///< pivot and rotation determine the place of all points; otherwise no motion is known
};

/// Consecutive poses of one motion: the pivot follows a polynomial of second degree, and the rotation per tick is constant.
/// Three poses determine such a motion. A further pose that does not agree with it begins a new motion.
class Track
{
public:
    static constexpr int needed = 3;

    /// A second pose for the same tick replaces the first. After a tick without a pose, a new motion begins.
    void add(std::uint32_t tick, const SampledPose &pose);

    /// Adds the last pose again, for a tick in which the object has not moved.
    void repeat(std::uint32_t tick) { append(tick, {history_.before_newest(0), rotations_[0], rounding_, true}); }

    bool has_begun() const { return history_.count() > 0; }
    bool is_known() const { return history_.count() >= needed; }
    bool rests() const; ///< the last three poses are equal

    /// The path through the last three positions, with time 0 at the newest. @pre is_known().
    Path path() const;
    Path fitted() const { return history_.fit().path; }

    /// Deviation from path() that rounding of the positions can cause.
    Deviation rounding() const;

    /// Upper bound of the distance by which rotation moves a point at distance 1 from the pivot, per tick.
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
