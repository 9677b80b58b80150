#ifndef ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_EFFORT_H
#define ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_EFFORT_H

namespace ode_predictive_space
{
// GCC defines macros; Clang has __has_feature().
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

/// The number of random cases to run: an eighth with a sanitizer, which makes them up to thirty times as slow.
constexpr int of_cases(int cases)
{
    return is_sanitized ? cases / 8 : cases;
}
} // namespace ode_predictive_space

#endif
