// All contenders of the benchmarks.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDERS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDERS_H

#include "demos/runs/spaces.h"

namespace ode_predictive_space::benchmarks
{
/// Their names: the spaces, and "brute", "sweep", "bullet-dbvt", "bullet-sap", "floor-boxes", "floor". Bullet's are included if
/// Bullet was found by the build.
const std::vector<std::string> &contender_names();

/// A contender of this name, for this world; "predictive" means "predictive-box".
///
/// @throws std::invalid_argument for a name that is not among contender_names().
std::unique_ptr<worlds::Contender> make_contender(const std::string &name, const worlds::WorldFactory &factory);

/// Whether a program can use it as a space: one of ODE's or a predictive one.
bool is_space(const std::string &name);
} // namespace ode_predictive_space::benchmarks

#endif
