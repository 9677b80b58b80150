#include "tests/benchmarks/instructions/callgrind_output.h"

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

/// The second of two numbers: the first is the line in the source.
std::uint64_t cost_in(const std::string &line)
{
    std::istringstream numbers(line);
    std::uint64_t position = 0;
    std::uint64_t cost = 0;
    if (!(numbers >> position >> cost))
    {
        throw std::runtime_error("callgrind wrote a line without a cost: " + line);
    }
    return cost;
}
} // namespace

// A call is three lines: cfn=FUNCTION, calls=NUMBER LINE, and where it is called from with its inclusive cost.
std::optional<std::uint64_t> instructions_of_any_calls(std::istream &dump, const std::string &function)
{
    std::uint64_t sum = 0;
    bool found = false;
    bool of_function = false;
    for (std::string line; std::getline(dump, line);)
    {
        if (starts_with(line, "events:") && line != "events: Ir")
        {
            throw std::runtime_error("callgrind counted other things than instructions: " + line);
        }
        if (starts_with(line, "cfn="))
        {
            of_function = line == "cfn=" + function;
        }
        else if (starts_with(line, "calls=") && of_function && std::getline(dump, line))
        {
            sum += cost_in(line);
            found = true;
        }
    }
    return found ? std::optional<std::uint64_t>(sum) : std::nullopt;
}

std::uint64_t instructions_of_calls(std::istream &dump, const std::string &function)
{
    const std::optional<std::uint64_t> sum = instructions_of_any_calls(dump, function);
    if (!sum)
    {
        throw std::runtime_error("callgrind counted no call of " + function);
    }
    return *sum;
}
} // namespace ode_predictive_space::benchmarks
