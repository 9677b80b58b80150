#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_RESULT_RECORDS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_RESULT_RECORDS_H

#include "demos/runs/world_run.h"

#include <nlohmann/json.hpp>
#include <string>

namespace ode_predictive_space::worlds
{
/// {scene, n, space, seed, ticks, measured_ticks, mean_us, median_us, p99_us, p999_us, max_us, pairs, pair_hash,
/// false_pairs, contacts}: times in microseconds per dSpaceCollide() over the measured ticks; the rest summed over all
/// ticks, with the warm-up; the hash in hexadecimal digits.
nlohmann::json record_of(const WorldRun &run, const WorldSpec &spec);

/// @throws std::runtime_error when the file cannot be written.
void write_json(const std::string &file, const nlohmann::json &value);
} // namespace ode_predictive_space::worlds

#endif
