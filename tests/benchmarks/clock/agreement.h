#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CLOCK_AGREEMENT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CLOCK_AGREEMENT_H

#include <array>
#include <benchmark/benchmark.h>
#include <cinttypes>
#include <cstdio>
#include <map>
#include <string>

namespace ode_predictive_space::benchmarks
{
/// The first hash of each row. The simple space is registered first, so the others are compared with it.
class Agreement
{
public:
    static Agreement &all()
    {
        static Agreement agreement;
        return agreement;
    }

    /// Labels a benchmark with the hash. It fails if an earlier one of the row `what` had another hash.
    void check(benchmark::State &state, const std::string &what, std::uint64_t hash)
    {
        std::array<char, 17> text{};
        std::snprintf(text.data(), text.size(), "%016" PRIx64, hash);
        state.SetLabel(text.data());
        if (first_.emplace(what, hash).first->second == hash)
            return;
        holds_ = false;
        state.SkipWithError("THE SPACES DISAGREE: an earlier one reported other pairs");
    }

    bool holds() const { return holds_; }

private:
    std::map<std::string, std::uint64_t> first_;
    bool holds_ = true;
};
} // namespace ode_predictive_space::benchmarks

#endif
