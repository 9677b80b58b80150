#include "tests/prediction/first_contact.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space
{
namespace
{
// Coefficients of relative position along an axis and of R1 + R2, by powers of m.
std::array<Real, 3> relative_coordinate(const Path &first, const Path &second, int axis, Real duration)
{
    const auto difference = [axis](const Vector3 &from, const Vector3 &to) {
        return Real(to[axis]) - Real(from[axis]);
    };
    return {difference(first.position, second.position), difference(first.velocity, second.velocity) * duration,
            difference(first.acceleration, second.acceleration) * duration * duration / 2};
}

std::array<Real, 3> joint_deviation(const Deviation &first, const Deviation &second, Real duration)
{
    return {Real(first.a) + second.a, (Real(first.b) + second.b) * duration,
            (Real(first.c) + second.c) * duration * duration};
}

void add_square(Polynomial &sum, const std::array<Real, 3> &term, Real sign)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            sum.coefficient[i + j] += sign * term[i] * term[j];
}

Real bisect(const Polynomial &polynomial, Real left, Real right)
{
    const bool right_is_positive = polynomial.at(right) > 0;
    for (;;)
    {
        const Real middle = left + (right - left) / 2;
        if (middle <= left || middle >= right)
            return right;
        ((polynomial.at(middle) > 0) == right_is_positive ? right : left) = middle;
    }
}

// The ends are 0, all places where the polynomial may turn, and 1.
std::vector<Real> monotone_pieces(const Polynomial &polynomial)
{
    std::vector<Real> ends = {0};
    if (polynomial.degree() > 1)
    {
        const std::vector<Real> turns = sign_changes(polynomial.derivative());
        ends.insert(ends.end(), turns.begin(), turns.end());
    }
    ends.push_back(1);
    return ends;
}
} // namespace

Real Polynomial::at(Real m) const
{
    Real value = 0;
    for (int k = 4; k >= 0; --k)
        value = value * m + coefficient[k];
    return value;
}

Polynomial Polynomial::derivative() const
{
    Polynomial result;
    for (int k = 1; k < 5; ++k)
        result.coefficient[k - 1] = k * coefficient[k];
    return result;
}

int Polynomial::degree() const
{
    int highest = 4;
    while (highest > 0 && coefficient[highest] == 0)
        --highest;
    return highest;
}

std::vector<Real> sign_changes(const Polynomial &polynomial)
{
    std::vector<Real> changes;
    const std::vector<Real> ends = monotone_pieces(polynomial);
    for (std::size_t i = 1; i < ends.size(); ++i)
        if ((polynomial.at(ends[i - 1]) > 0) != (polynomial.at(ends[i]) > 0))
            changes.push_back(bisect(polynomial, ends[i - 1], ends[i]));
    return changes;
}

std::optional<Real> first_not_positive(const Polynomial &polynomial)
{
    if (polynomial.at(0) <= 0)
        return Real(0);
    const std::vector<Real> ends = monotone_pieces(polynomial);
    for (std::size_t i = 1; i < ends.size(); ++i)
        if (polynomial.at(ends[i]) <= 0)
            return bisect(polynomial, ends[i - 1], ends[i]);
    return std::nullopt;
}

Polynomial sphere_polynomial(const Envelope &first, const Envelope &second, double duration, double extra_reach)
{
    Polynomial result;
    for (int axis = 0; axis < 3; ++axis)
        add_square(result, relative_coordinate(first.path, second.path, axis, duration), 1);
    std::array<Real, 3> reach = joint_deviation(first.deviation, second.deviation, duration);
    reach[0] += Real(first.radius) + second.radius + extra_reach;
    add_square(result, reach, -1);
    return result;
}

std::optional<Real> first_sphere_contact(const Envelope &first, const Envelope &second, double duration)
{
    return first_not_positive(sphere_polynomial(first, second, duration));
}

std::array<Polynomial, 6> box_gaps(const Envelope &first, const Envelope &second, double duration)
{
    std::array<Polynomial, 6> gaps;
    const std::array<Real, 3> deviation = joint_deviation(first.deviation, second.deviation, duration);
    for (int axis = 0; axis < 3; ++axis)
    {
        const std::array<Real, 3> distance = relative_coordinate(first.path, second.path, axis, duration);
        Polynomial &above = gaps[2 * axis];
        Polynomial &below = gaps[2 * axis + 1];
        for (int k = 0; k < 3; ++k)
        {
            above.coefficient[k] = distance[k] - deviation[k];
            below.coefficient[k] = -distance[k] - deviation[k];
        }
        above.coefficient[0] += Real(second.low[axis]) - first.high[axis];
        below.coefficient[0] += Real(first.low[axis]) - second.high[axis];
    }
    return gaps;
}

std::optional<Real> first_box_contact(const Envelope &first, const Envelope &second, double duration)
{
    // The answer is 0 or a place where one of the gaps closes. There, the gap itself counts as closed.
    const std::array<Polynomial, 6> gaps = box_gaps(first, second, duration);
    const auto all_closed = [&gaps](Real m, const Polynomial *closing) {
        return std::all_of(gaps.begin(), gaps.end(),
                           [&](const Polynomial &gap) { return &gap == closing || gap.at(m) <= 0; });
    };
    if (all_closed(0, nullptr))
        return Real(0);
    std::optional<Real> first_contact;
    for (const Polynomial &gap : gaps)
        for (const Real m : sign_changes(gap))
            if (all_closed(m, &gap) && (!first_contact || m < *first_contact))
                first_contact = m;
    return first_contact;
}
} // namespace ode_predictive_space
