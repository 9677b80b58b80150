// The time of proximity of two envelopes (Vogiannou et al., equations 1 to 6, with two corrections): of their bounding spheres, and
// of their boxes.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_PROXIMITY_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_PROXIMITY_H

#include <optional>

#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// First m >= 0 at which A m^2 + 2 B m + C <= 0, or none.
///
/// C <= 0 gives 0. Otherwise, with D = B^2 - A C, the root is C / (sqrt(D) - B) if D >= 0 and sqrt(D) > B: for every sign of
/// A and B, also for A = 0. It does not cancel, except when B > 0, where a root needs A < 0; there the same root is
/// (B + sqrt(D)) / -A. Anything that is not a number gives 0: nothing is known to be apart.
std::optional<double> first_root(double A, double B, double C);

/// The paper's P(m) = A m^2 + 2 B m + C over a horizon, m = t / duration (equation 6): the squared distance of two paths'
/// chords less the square of what proximity allows them.
struct ProximityPolynomial
{
    double A, B, C;
    double at(double m) const { return (A * m + 2 * B) * m + C; }
};

/// P(m) of two envelopes' bounding spheres; both radii finite. `error` is e, what the chords owe to the paths. P is rounded
/// down: for m >= 0 it is never above the true one.
ProximityPolynomial proximity_polynomial(const Envelope &first, const Envelope &second, double duration, double error);

/// The e that makes P(m) <= 0 necessary for proximity: the chord error of the relative path (see chord_error()). It is zero
/// for two bodies in free fall, and never more than the sum of both paths' own errors.
double sphere_chord_error(const Envelope &first, const Envelope &second, double duration);

/// Earliest time in [0, duration] at which the bounding spheres, grown by the deviations, may touch; `duration` >= 0.
///
/// Never late: before it, they are apart as long as both objects keep to their envelopes. None: apart until `duration`, that
/// included. A pair of which one radius is infinite, or anything not a number, is near at once.
std::optional<double> sphere_time_of_proximity(const Envelope &first, const Envelope &second, double duration);

/// The same of the boxes: equation 1 by slabs, per axis |distance| <= half extents + R(t), over the chords of equation 6 and lowered
/// by the whole chord error (docs/how_it_works.md). A side that is infinite or not a number is near.
std::optional<double> box_time_of_proximity(const Envelope &first, const Envelope &second, double duration);

/// One of the two above.
using TimeOfProximity = std::optional<double>(const Envelope &first, const Envelope &second, double duration);

/// The same time, later, where paths bend: a horizon in which the two may be near is halved up to so many times. With each halving,
/// the chord error is a quarter of what it was.
std::optional<double> time_in_halves(TimeOfProximity &time, const Envelope &first, const Envelope &second,
                                     double duration, int halvings);
} // namespace ode_predictive_space

#endif
