#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDERS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDERS_H

#include "demos/runs/spaces.h"

namespace ode_predictive_space::benchmarks
{
/// The spaces, and "brute", "sweep", "bullet-dbvt", "bullet-sap" (with Bullet only).
const std::vector<std::string> &contender_names();

/// A contender for this world; "predictive" means "predictive-box". @throws std::invalid_argument for an unknown name.
std::unique_ptr<worlds::Contender> make_contender(const std::string &name, const worlds::WorldFactory &factory);

bool is_space(const std::string &name);
} // namespace ode_predictive_space::benchmarks

#endif
