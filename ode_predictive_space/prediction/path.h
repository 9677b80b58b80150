// The predicted path of an object: s(t) = p + v t + 1/2 a t^2 (Vogiannou et al., section 3).

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_PATH_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_PATH_H

#include <limits>

#include <Eigen/Core>

namespace ode_predictive_space
{
using Vector3 = Eigen::Vector3d;

/// Lengths are in the scene's unit, times in ticks.
struct Path
{
    Vector3 position = Vector3::Zero();     ///< p, at time 0
    Vector3 velocity = Vector3::Zero();     ///< v, per tick
    Vector3 acceleration = Vector3::Zero(); ///< a, per tick^2

    Vector3 at(double t) const { return position + t * (velocity + (0.5 * t) * acceleration); }

    /// The curve with the origin of time moved to t.
    Path advanced(double t) const { return {at(t), velocity + t * acceleration, acceleration}; }
};

inline Path relative_path(const Path &first, const Path &second)
{
    return {second.position - first.position, second.velocity - first.velocity,
            second.acceleration - first.acceleration};
}

/// Largest distance between a path and its chord over [0, T], at equal times: 1/8 |a| T^2.
/// The paper's equation 4 keeps only the part perpendicular to the chord. This bounds the swept volume, but not the time:
/// an object that accelerates along its own line is ahead of or behind its chord by up to the whole error.
inline double chord_error(const Vector3 &acceleration, double duration)
{
    return 0.125 * duration * duration * acceleration.norm();
}

/// Upper bound, per axis and over [0, duration], of the sum of the absolute values of a coordinate's terms. The terms may
/// cancel, but their rounding errors, which are proportional to this sum, do not.
inline Vector3 size_of_terms(const Path &path, double duration)
{
    return path.position.cwiseAbs() + duration * (path.velocity.cwiseAbs() + duration * path.acceleration.cwiseAbs());
}

/// Rounding adds less to a distance than this factor times the sum of its terms' absolute values. A bound of an envelope or a
/// distance takes a dozen operations, each with an error of at most half an epsilon; `advanced()` takes four more.
constexpr double rounding_per_size = 16 * std::numeric_limits<double>::epsilon();
} // namespace ode_predictive_space

#endif
