#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_RESULT_RECORDS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_RESULT_RECORDS_H

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ode_predictive_space::worlds
{
/// Prints a table with a row for each record. @param fields the columns; a record without one has "-" there.
void print_records(std::ostream &out, const nlohmann::json &records, const std::vector<std::string> &fields);

/// Checks before a run that its results can be written; leaves the file as it was. @throws std::runtime_error when they cannot.
void check_writable(const std::string &file);

/// @throws std::runtime_error when the file cannot be written.
void write_json(const std::string &file, const nlohmann::json &value);
} // namespace ode_predictive_space::worlds

#endif
