// The earliest contact of two shapes, for forecast queries. In: the present shapes, and predictions. Out: a time that is never
// later than the contact, as long as both objects keep to their predictions.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_CONTACT_FORECAST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_CONTACT_FORECAST_H

#include <optional>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
struct PredictedShape
{
    const ConvexShape &shape;
    Envelope envelope;
    bool still;        ///< no motion is predicted
    bool about_centre; ///< its centre follows the path, and the sphere around it holds the object in any orientation
    bool turns = true; ///< turning may extend its reach; false if it does not turn, or if the deviation covers that
};

/// The present gap is closed by the predicted motion along its axis, by both deviations, and by turning: an object that may
/// turn counts as its bounding sphere. A gap to the surface of a mesh or heightfield may close along any axis.
/// @param margin distance up to which the shapes count as touching.
/// @param duration validity of both predictions, in ticks; may be infinite.
/// @return ticks from now: 0 if the shapes may touch now, otherwise at least 1; none if they stay apart for the duration.
std::optional<double> time_of_contact(const PredictedShape &first, const PredictedShape &second, double margin,
                                      double duration);
} // namespace ode_predictive_space

#endif
