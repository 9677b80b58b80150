// The true first time at which two envelopes touch, found without chords: the reference for the prediction.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_PREDICTION_FIRST_CONTACT_H
#define ODE_PREDICTIVE_SPACE_TESTS_PREDICTION_FIRST_CONTACT_H

#include <array>
#include <optional>
#include <vector>

#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// Wider than double, so that the reference's own rounding is far below the prediction's margins.
using Real = long double;

struct Polynomial
{
    std::array<Real, 5> coefficient{};

    Real at(Real m) const;
    Polynomial derivative() const;
    int degree() const;
};

/// All m in [0, 1] where the polynomial changes its sign, in ascending order. Between two neighbours of 0, the sign
/// changes of the derivative and 1 it is monotone, so that bisection cannot miss one.
std::vector<Real> sign_changes(const Polynomial &polynomial);

std::optional<Real> first_not_positive(const Polynomial &polynomial);

/// |s1 - s2|^2 - (R1 + R2 + r1 + r2 + extra_reach)^2 as a polynomial of m = t / duration (equation 1, squared).
Polynomial sphere_polynomial(const Envelope &first, const Envelope &second, double duration, double extra_reach = 0);

std::optional<Real> first_sphere_contact(const Envelope &first, const Envelope &second, double duration);

/// The gaps between the grown boxes, as polynomials of m: below and above on each axis. They overlap when none is positive.
std::array<Polynomial, 6> box_gaps(const Envelope &first, const Envelope &second, double duration);

std::optional<Real> first_box_contact(const Envelope &first, const Envelope &second, double duration);
} // namespace ode_predictive_space

#endif
