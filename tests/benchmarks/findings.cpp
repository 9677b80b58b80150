#include "tests/benchmarks/findings.h"

#include "demos/runs/table.h"

#include <algorithm>
#include <ostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
/// P9 comes before P10.
int number_of(const Requirement &requirement)
{
    return std::stoi(requirement.line.substr(1));
}

std::string bound_text(const Requirement &requirement)
{
    return requirement.bound == Requirement::at_least ? ">=" : "<=";
}

std::string with_unit(double value, const std::string &unit)
{
    return worlds::fixed(value, 2) + " " + unit;
}

nlohmann::json record_of(const Requirement &requirement)
{
    return {{"line", requirement.line},         {"what", requirement.what},   {"value", requirement.value},
            {"bound", bound_text(requirement)}, {"limit", requirement.limit}, {"unit", requirement.unit},
            {"met", requirement.met()}};
}

void print_requirements(std::ostream &out, std::vector<Requirement> requirements)
{
    std::stable_sort(requirements.begin(), requirements.end(),
                     [](const Requirement &a, const Requirement &b) { return number_of(a) < number_of(b); });
    worlds::Table table({"asked for", "measured", "limit", "met"});
    for (const Requirement &requirement : requirements)
    {
        table.add({requirement.line + "  " + requirement.what, with_unit(requirement.value, requirement.unit),
                   bound_text(requirement) + " " + with_unit(requirement.limit, requirement.unit),
                   requirement.met() ? "yes" : "no"});
    }
    out << '\n';
    table.print(out);
    const auto met = std::count_if(requirements.begin(), requirements.end(), [](const auto &r) { return r.met(); });
    out << met << " of " << requirements.size() << " met.\n";
}
} // namespace

void Findings::note(std::string text)
{
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end())
    {
        notes_.push_back(std::move(text));
    }
}

void Findings::fail(ExitStatus status)
{
    if (status_ == exit_ok)
    {
        status_ = status;
    }
}

nlohmann::json Findings::records() const
{
    nlohmann::json all = records_;
    for (const Requirement &requirement : requirements_)
    {
        all.push_back(record_of(requirement));
    }
    return all;
}

void Findings::print(std::ostream &out) const
{
    if (!requirements_.empty())
    {
        print_requirements(out, requirements_);
    }
    if (!notes_.empty())
    {
        out << '\n';
    }
    for (const std::string &note : notes_)
    {
        out << "Note: " << note << '\n';
    }
}
} // namespace ode_predictive_space::benchmarks
