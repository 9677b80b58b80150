// The time of proximity of two envelopes, by spheres and by boxes (Vogiannou et al., equations 1 to 6, with two corrections).

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_PROXIMITY_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_PROXIMITY_H

#include <optional>

#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// First m >= 0 at which A m^2 + 2 B m + C <= 0, or none; 0 if C <= 0, and for NaN: nothing is known to be apart.
/// With D = B^2 - A C, the root is C / (sqrt(D) - B) if D >= 0 and sqrt(D) > B, for every sign of A and B, also for A = 0.
/// This form cancels only for B > 0. A root then needs A < 0 and is computed as (B + sqrt(D)) / -A.
std::optional<double> first_root(double A, double B, double C);

/// The paper's P(m) = A m^2 + 2 B m + C over a horizon, m = t / duration (equation 6): the squared distance between the chords
/// of two paths, less the square of the distance at which the objects may be near.
struct ProximityPolynomial
{
    double A, B, C;
};

/// P(m) of the bounding spheres, rounded down for m >= 0. @pre both radii are finite. @param error e, see sphere_chord_error().
ProximityPolynomial proximity_polynomial(const Envelope &first, const Envelope &second, double duration, double error);

/// The e that makes P(m) <= 0 necessary for proximity: the chord error of the relative path (see chord_error()). It is zero
/// for two bodies in free fall, and never exceeds the sum of the errors of both paths.
double sphere_chord_error(const Envelope &first, const Envelope &second, double duration);

/// Earliest time in [0, duration], `duration` >= 0, at which the bounding spheres, grown by the deviations, may touch.
/// @return none if the spheres are apart over all of [0, duration]; 0 if a radius is infinite or any value is NaN.
std::optional<double> sphere_time_of_proximity(const Envelope &first, const Envelope &second, double duration);

/// As sphere_time_of_proximity(), for boxes: equation 1 by slabs, |distance| <= half extents + R(t) along each axis, over
/// chords (equation 6) with the whole chord error of the axis. A side that is infinite or NaN never proves boxes apart.
std::optional<double> box_time_of_proximity(const Envelope &first, const Envelope &second, double duration);

using TimeOfProximity = std::optional<double>(const Envelope &first, const Envelope &second, double duration);

/// Refines `time` for relative paths that bend: halves a horizon in which the two may be near, up to `halvings` times. Each
/// halving divides the chord error by four, so the result may be later, or none, but is still never late.
std::optional<double> time_in_halves(TimeOfProximity &time, const Envelope &first, const Envelope &second,
                                     double duration, int halvings);
} // namespace ode_predictive_space

#endif
