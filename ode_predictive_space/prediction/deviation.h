// How far from its estimated path an object may be: R(t) = a + b t + c t^2.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_DEVIATION_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_DEVIATION_H

namespace ode_predictive_space
{
/// A distance that grows with time; a, b, c >= 0, in the scene's unit, per tick, per tick^2.
///
/// As c >= 0, R is convex: its chord over any interval lies above it and needs no correction.
struct Deviation
{
    double a = 0;
    double b = 0;
    double c = 0;

    /// R(t).
    double at(double t) const { return a + growth(t); }

    /// R(t) - R(0).
    double growth(double t) const { return t * (b + t * c); }

    /// The same deviation with its time counted from t >= 0 on.
    Deviation advanced(double t) const { return {at(t), b + 2 * c * t, c}; }
};

/// A deviation so many times as large.
inline Deviation operator*(double factor, const Deviation &deviation)
{
    return {factor * deviation.a, factor * deviation.b, factor * deviation.c};
}

/// The deviation of the relative position of two objects.
inline Deviation operator+(const Deviation &first, const Deviation &second)
{
    return {first.a + second.a, first.b + second.b, first.c + second.c};
}
} // namespace ode_predictive_space

#endif
