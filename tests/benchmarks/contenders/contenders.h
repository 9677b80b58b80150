#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDERS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDERS_H

#include "demos/worlds/spaces.h"
#include "tests/benchmarks/contenders/contender.h"

namespace ode_predictive_space::benchmarks
{
/// All spaces, and "brute", "sweep", "bullet-dbvt", "bullet-sap" (with Bullet only).
std::vector<std::string> contender_names();

/// A contender for this world. @throws std::invalid_argument for an unknown name.
std::unique_ptr<Contender> make_contender(const std::string &name, const worlds::WorldFactory &factory);

bool is_space(const std::string &contender);
} // namespace ode_predictive_space::benchmarks

#endif
