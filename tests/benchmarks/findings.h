// What a run of predictive_bench has found: records for other programs, requirements and whether they are met, notes.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_FINDINGS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_FINDINGS_H

#include <iosfwd>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
struct Comparison;

/// What the program returns.
enum ExitStatus
{
    exit_ok = 0,
    exit_wrong_pairs = 1, ///< contenders that must agree did not, or a predictive space failed its check
    exit_failed = 2       ///< the benchmark could not be run, or the command line is wrong
};

/// A figure that is asked for, and the figure that was measured.
struct Requirement
{
    enum Bound
    {
        at_least,
        at_most
    };

    std::string line; ///< its name: "P1" … "P14"
    std::string what; ///< in which scene, of which size
    double value = 0; ///< measured
    Bound bound = at_least;
    double limit = 0;
    std::string unit; ///< of both: "x", "%", "bytes per geom"

    bool met() const { return bound == at_least ? value >= limit : value <= limit; }
};

/// Commands add to it; whoever has called them prints it, writes it and returns its status.
class Findings
{
public:
    void record(nlohmann::json record) { records_.push_back(std::move(record)); }
    void require(Requirement requirement) { requirements_.push_back(std::move(requirement)); }

    /// Something that whoever reads the figures must know: what was left out, and why.
    void note(std::string text);

    /// Comparisons of scenes that have been shown, for commands that would make the same; see compare_once().
    using Comparisons = std::vector<std::shared_ptr<const Comparison>>;
    const Comparisons &comparisons() const { return comparisons_; }
    void keep(std::shared_ptr<const Comparison> comparison) { comparisons_.push_back(std::move(comparison)); }

    /// Something went wrong; the first status other than exit_ok stays.
    void fail(ExitStatus status);

    /// A list: of what record() was given and, at its end, one record {line, what, value, bound, limit, unit, met} for each
    /// requirement.
    nlohmann::json records() const;
    const std::vector<Requirement> &requirements() const { return requirements_; }
    ExitStatus status() const { return status_; }

    /// The requirements as a table in the order of their lines, then the notes. Nothing when there are none.
    void print(std::ostream &out) const;

private:
    nlohmann::json records_ = nlohmann::json::array();
    std::vector<Requirement> requirements_;
    std::vector<std::string> notes_;
    Comparisons comparisons_;
    ExitStatus status_ = exit_ok;
};
} // namespace ode_predictive_space::benchmarks

#endif
