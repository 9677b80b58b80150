#include "tests/benchmarks/instructions/callgrind_output.h"

#include <array>
#include <istream>
#include <sstream>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
bool starts_with(const std::string &line, const char *beginning)
{
    return line.rfind(beginning, 0) == 0;
}

// Data misses are the fifth and sixth event, of reads and of writes; those of the last level are the eighth and ninth.
constexpr const char *only_instructions = "events: Ir";
constexpr const char *with_caches = "events: Ir Dr Dw I1mr D1mr D1mw ILmr DLmr DLmw";
constexpr std::size_t most_events = 9;

/// The numbers after the first one, which is the line in the source. Zeros at the end are not written.
Costs costs_in(const std::string &line)
{
    std::istringstream numbers(line);
    std::uint64_t position = 0;
    std::array<std::uint64_t, most_events> events{};
    if (!(numbers >> position >> events[0]))
    {
        throw std::runtime_error("callgrind wrote a line without a cost: " + line);
    }
    for (std::size_t i = 1; i < events.size() && numbers >> events[i]; ++i)
    {}
    return {events[0], events[4] + events[5], events[7] + events[8]};
}

void add(Costs &sum, const Costs &costs)
{
    sum.instructions += costs.instructions;
    sum.first_level_misses += costs.first_level_misses;
    sum.last_level_misses += costs.last_level_misses;
}
} // namespace

// A call is three lines: cfn=FUNCTION, calls=NUMBER LINE, and where it is called from with its inclusive cost.
std::optional<Costs> costs_of_any_calls(std::istream &dump, const std::string &function)
{
    std::optional<Costs> sum;
    bool of_function = false;
    for (std::string line; std::getline(dump, line);)
    {
        if (starts_with(line, "events:") && line != only_instructions && line != with_caches)
        {
            throw std::runtime_error("callgrind counted other things than instructions: " + line);
        }
        if (starts_with(line, "cfn="))
        {
            of_function = line == "cfn=" + function;
        }
        else if (starts_with(line, "calls=") && of_function && std::getline(dump, line))
        {
            sum = sum.value_or(Costs());
            add(*sum, costs_in(line));
        }
    }
    return sum;
}

Costs costs_of_calls(std::istream &dump, const std::string &function)
{
    const std::optional<Costs> sum = costs_of_any_calls(dump, function);
    if (!sum)
    {
        throw std::runtime_error("callgrind counted no call of " + function);
    }
    return *sum;
}
} // namespace ode_predictive_space::benchmarks
