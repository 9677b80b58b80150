// All that can take part in a benchmark.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDERS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDERS_H

#include "demos/runs/spaces.h"

namespace ode_predictive_space::benchmarks
{
/// Below so many objects a tick is so short that reading the clock would be a part of what is measured.
constexpr int objects_for_single_ticks = 300;

/// Their names: the spaces, and "brute", "sweep", "bullet-dbvt", "bullet-sap", "floor-boxes", "floor". Bullet's only when
/// it was there to build with.
const std::vector<std::string> &contender_names();

/// A contender of this name, for this scene; "predictive" is another name of "predictive-box".
///
/// @throws std::invalid_argument for a name that is none of contender_names().
std::unique_ptr<worlds::Contender> make_contender(const std::string &name, const worlds::WorldFactory &factory);

/// Is it one of Bullet's broad phases?
bool is_bullet(const std::string &name);

/// Is it one of those that know the pairs beforehand?
bool is_floor(const std::string &name);

/// Why a contender cannot take part in a scene, as a half-sentence; empty when it can.
std::string why_not(const std::string &name, const worlds::WorldSpec &spec);

constexpr bool have_bullet =
#ifdef ODE_PREDICTIVE_SPACE_HAVE_BULLET
    true;
#else
    false;
#endif
} // namespace ode_predictive_space::benchmarks

#endif
