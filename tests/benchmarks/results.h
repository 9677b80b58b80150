#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_RESULTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_RESULTS_H

#include "demos/runs/result_records.h"
#include "demos/runs/spaces.h"
#include "tests/benchmarks/which_ode.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
inline void print_records(const nlohmann::json &records)
{
    std::vector<std::string> fields;
    for (const auto &[name, value] : records.at(0).items())
        fields.push_back(name);
    worlds::print_records(std::cout, records, fields);
    std::cout << '\n' << std::flush;
}

/// main() of a program that measures and prints, with the options --json FILE and those that `add_options` adds; `measure`
/// returns records for the file. @return the exit status: 0, or 2 after a failure or for a wrong command line.
template <typename AddOptions, typename Measure>
int run_program(int argc, char **argv, const char *text, AddOptions add_options, Measure measure)
{
    CLI::App app(text);
    std::string file;
    app.add_option("--json", file, "Write the results to this file, too")->type_name("FILE");
    add_options(app);
    try
    {
        app.parse(argc, argv);
        const worlds::OdeSession ode;
        std::cout << which_ode() << "\n\n" << std::flush;
        const nlohmann::json records = measure();
        if (!file.empty())
            worlds::write_json(file, records);
        return std::cout.flush() ? 0 : 2;
    }
    catch (const CLI::ParseError &end)
    {
        return app.exit(end) == 0 ? 0 : 2;
    }
    catch (const std::exception &failure)
    {
        std::cerr << argv[0] << ": " << failure.what() << '\n';
        return 2;
    }
}
} // namespace ode_predictive_space::benchmarks

#endif
