#include "demos/ode/options.h"

#include <filesystem>
#include <stdexcept>

namespace ode_predictive_space::ode_demos
{
Options read_options(int argc, char **argv)
{
    Options options;
    options.program = std::filesystem::path(argv[0]).filename().string();
    for (int i = 1; i < argc; ++i)
    {
        const std::string name = argv[i];
        if (name != "-probe" && name != "-keys" && name != "-headless")
            continue;
        if (++i >= argc)
            throw std::invalid_argument(name + " needs a value");
        if (name == "-probe")
            options.device = argv[i];
        else if (name == "-keys")
            options.keys = argv[i];
        else
            options.headless = true;
    }
    return options;
}
} // namespace ode_predictive_space::ode_demos
