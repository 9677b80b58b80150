#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_RESULTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_RESULTS_H

#include "demos/worlds/spaces.h"
#include "tests/benchmarks/which_ode.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace ode_predictive_space::benchmarks
{
inline std::string cell(const nlohmann::json &value)
{
    if (!value.is_number_float())
        return value.is_string() ? value.get<std::string>() : value.dump();
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << value.get<double>();
    return text.str();
}

/// Prints a table with a row for each record. @pre there is one, and all have the same fields.
inline void print_records(const nlohmann::json &records)
{
    static constexpr std::size_t widest_cell = 22; // "broad and narrow phase"
    const auto put = [](const std::string &name, const std::string &text) {
        std::cout << std::setw(static_cast<int>(std::max(name.size(), widest_cell)) + 2) << text;
    };
    for (const auto &[name, value] : records.at(0).items())
        put(name, name);
    for (const nlohmann::json &record : records)
    {
        std::cout << '\n';
        for (const auto &[name, value] : record.items())
            put(name, cell(value));
    }
    std::cout << "\n\n" << std::flush;
}

inline void write_json(const std::string &file, const nlohmann::json &value)
{
    std::ofstream out(file);
    if (!(out << value.dump(2) << '\n').flush())
        throw std::runtime_error(file + " cannot be written");
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
            write_json(file, records);
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
