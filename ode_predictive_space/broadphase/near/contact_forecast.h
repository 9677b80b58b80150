// When can the shapes of two objects touch? For questions of a program. In: shapes as they are now, and predictions. Out: a time
// that is never later than the contact, as long as both objects keep to their predictions.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_CONTACT_FORECAST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_CONTACT_FORECAST_H

#include <optional>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// An object as it is now, and its prediction, whose time is counted from now on.
struct PredictedShape
{
    const ConvexShape &shape;
    Envelope envelope;
    bool still;        ///< predicted to stay as it is
    bool about_centre; ///< its centre follows the path, and the sphere around it holds the object however it turns
    bool turns = true; ///< unless it is still; false, too, when the deviation includes what turning moves
};

/// The gap along the axis on which two shapes are apart now is closed by their predicted motion along that axis, by both
/// deviations, and by turning: an object that may turn is taken to reach as far as its bounding sphere. The gap to the surface of a
/// mesh or heightfield, where its hull has none, may close along any axis.
///
/// @param margin up to this distance the shapes count as touching.
/// @param duration for how long both predictions are valid, in ticks; may be infinite.
/// @return in ticks from now: 0 when the shapes may touch now, else at least 1, the next tick. None when they stay apart for that
/// long.
std::optional<double> time_of_contact(const PredictedShape &first, const PredictedShape &second, double margin,
                                      double duration);
} // namespace ode_predictive_space

#endif
