// The deviation R(t) = a + b t + c t^2: how far an object may be from its predicted path.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_DEVIATION_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_DEVIATION_H

namespace ode_predictive_space
{
/// a, b, c >= 0, in the scene's unit, per tick, per tick^2. R is convex, so its chord over any interval lies above it.
struct Deviation
{
    double a = 0;
    double b = 0;
    double c = 0;

    double at(double t) const { return a + growth(t); }

    double growth(double t) const { return t * (b + t * c); }

    /// The deviation with the origin of time moved to t >= 0.
    Deviation advanced(double t) const { return {at(t), b + 2 * c * t, c}; }
};

inline Deviation operator*(double factor, const Deviation &deviation)
{
    return {factor * deviation.a, factor * deviation.b, factor * deviation.c};
}

inline Deviation operator+(const Deviation &first, const Deviation &second)
{
    return {first.a + second.a, first.b + second.b, first.c + second.c};
}
} // namespace ode_predictive_space

#endif
