// How much of a randomised test is run.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_EFFORT_H
#define ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_EFFORT_H

namespace ode_predictive_space
{
/// Of so many random cases; a sanitizer, which makes them up to thirty times as slow, sees an eighth.
constexpr int of_cases(int cases)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return cases / 8;
#else
    return cases;
#endif
}
} // namespace ode_predictive_space

#endif
