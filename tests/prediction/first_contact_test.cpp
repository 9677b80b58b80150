// The reference itself must be right: it is compared with other ways to find the same roots.

#include "tests/prediction/first_contact.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <gtest/gtest.h>
#include <unsupported/Eigen/Polynomials>

#include "tests/prediction/random_pairs.h"

using namespace ode_predictive_space;

namespace
{
// First real root in (0, 1] from the eigenvalues of the companion matrix.
std::optional<double> first_root_by_companion_matrix(const Polynomial &polynomial)
{
    const int degree = polynomial.degree();
    Eigen::VectorXd coefficients(degree + 1);
    for (int k = 0; k <= degree; ++k)
        coefficients[k] = static_cast<double>(polynomial.coefficient[k]);
    const Eigen::PolynomialSolver<double, Eigen::Dynamic> solver(coefficients);
    std::optional<double> first;
    for (const std::complex<double> &root : solver.roots())
        if (std::abs(root.imag()) < 1e-9 && root.real() > 0 && root.real() <= 1 && (!first || root.real() < *first))
            first = root.real();
    return first;
}

template <typename Positive> void expect_positive_before(std::optional<Real> contact, Positive positive)
{
    const Real end = contact ? *contact * (1 - 1e-8L) : 1; // a double root is known to half the digits only
    for (int i = 0; i < 200; ++i)
        ASSERT_TRUE(positive(end * i / 199)) << "at " << i << " of 199";
}
} // namespace

TEST(FirstContact, known_polynomials)
{
    EXPECT_FALSE(first_not_positive({{1, 0, 0, 0, 0}}));
    EXPECT_EQ(first_not_positive({{0, 0, 0, 0, 0}}), 0);
    EXPECT_NEAR(static_cast<double>(*first_not_positive({{1, -2, 0, 0, 0}})), 0.5, 1e-18);
    // (m - 1/4) (m - 1/2) (m - 3/4) (m - 2)
    const Polynomial quartic = {{0.1875L, -1.46875L, 3.6875L, -3.5L, 1}};
    const std::vector<Real> roots = sign_changes(quartic);
    ASSERT_EQ(roots.size(), 3U);
    EXPECT_NEAR(static_cast<double>(roots[0]), 0.25, 1e-17);
    EXPECT_NEAR(static_cast<double>(roots[1]), 0.5, 1e-17);
    EXPECT_NEAR(static_cast<double>(roots[2]), 0.75, 1e-17);
    // A double root: touched and not crossed.
    EXPECT_NEAR(static_cast<double>(*first_not_positive({{0.25L, -1, 1, 0, 0}})), 0.5, 1e-9);
}

TEST(FirstContact, of_spheres_agrees_with_the_companion_matrix)
{
    RandomPairs random(11);
    int compared = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const EnvelopePair pair = random.make(PairKind::curved);
        const Polynomial polynomial = sphere_polynomial(pair.first, pair.second, pair.duration);
        const std::optional<Real> contact = first_not_positive(polynomial);
        if (!contact || *contact == 0)
            continue;
        const std::optional<double> root = first_root_by_companion_matrix(polynomial);
        if (!root) // double roots are complex by a rounding there
            continue;
        ++compared;
        ASSERT_NEAR(static_cast<double>(*contact), *root, 1e-5) << "pair " << i;
    }
    EXPECT_GT(compared, 5000);
}

TEST(FirstContact, nothing_touches_before_it)
{
    RandomPairs random(12);
    for (int i = 0; i < 500 * pair_kinds; ++i)
    {
        const EnvelopePair pair = random.make(static_cast<PairKind>(i % pair_kinds));
        const Polynomial sphere = sphere_polynomial(pair.first, pair.second, pair.duration);
        const std::optional<Real> sphere_contact = first_sphere_contact(pair.first, pair.second, pair.duration);
        if (sphere_contact != Real(0))
            expect_positive_before(sphere_contact, [&](Real m) { return sphere.at(m) > 0; });

        const std::array<Polynomial, 6> gaps = box_gaps(pair.first, pair.second, pair.duration);
        const std::optional<Real> box_contact = first_box_contact(pair.first, pair.second, pair.duration);
        if (box_contact != Real(0))
            expect_positive_before(box_contact, [&](Real m) {
                return std::any_of(gaps.begin(), gaps.end(), [m](const Polynomial &gap) { return gap.at(m) > 0; });
            });
        ASSERT_FALSE(HasFatalFailure()) << "pair " << i;
    }
}
