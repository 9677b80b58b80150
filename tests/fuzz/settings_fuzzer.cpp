// Any bytes as the environment of a program with the preload: five values, each followed by a zero byte.

#include <array>
#include <cstdlib>
#include <string>

#include <ode_predictive_space/predictive_space.h>

#include "ode_predictive_space/preload/settings.h"
#include "tests/fuzz/fuzz_target.h"

using namespace ode_predictive_space::preload;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    constexpr std::array<const char *, 5> names{"ODE_PREDICTIVE_SPACE", "ODE_PREDICTIVE_PROXIMITY",
                                                "ODE_PREDICTIVE_STATS", "ODE_PREDICTIVE_RECORD_LIMIT",
                                                "ODE_PREDICTIVE_TRACE"};
    std::array<std::string, names.size()> values;
    for (std::size_t i = 0, value = 0; i < size && value < values.size(); ++i)
        if (data[i] == 0)
            ++value;
        else
            values[value].push_back(static_cast<char>(data[i]));
    std::vector<std::string> complaints;
    const Settings settings = read_settings(
        [&](const char *name) -> const char * {
            for (std::size_t i = 0; i < names.size(); ++i)
                if (std::string(name) == names[i])
                    return values[i].c_str();
            return nullptr;
        },
        complaints);
    // There is at most one sentence for each variable with a list of words; classes have names; files are as given.
    bool right = complaints.size() <= 3 && (settings.stats_file.empty() || settings.stats_file == values[2]) &&
                 settings.trace_file == values[4] && settings.record_limit > 0 &&
                 settings.proximity >= dPredictiveProximityBox && settings.proximity <= dPredictiveProximityShape;
    for (int space_class : settings.replaced)
        right = right && std::string(name_of_space_class(space_class)) != "unknown";
    if (!right)
        std::abort();
    return 0;
}
