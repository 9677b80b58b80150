// Instructions per whole tick of scenes in spaces: what a program needs that steps a world.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_WHOLE_COUNTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_WHOLE_COUNTS_H

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/benchmarks/instructions/counts.h"

namespace ode_predictive_space::benchmarks
{
/// Instructions are per tick, each with all that was called.
struct WholeCount : CountedScene
{
    double collide = 0;           ///< dSpaceCollide(), with a callback that only notes the pair
    double contacts = 0;          ///< dCollide() for the reported pairs
    double notices = 0;           ///< dGeomMoved(), called by the step of the world or by the scene
    double whole = 0;             ///< motion with the step of the world, dSpaceCollide(), dCollide() and contact joints
    double calls_per_tick = 0;    ///< of dCollide()
    double contacts_per_tick = 0; ///< that they found
    std::string state_hash = {};  ///< of where all geoms are at the end; in hexadecimal digits

    double both() const { return collide + contacts; }
};

/// {count: "whole ticks", scene, n, seed, warm_up_ticks, ticks, space, collide, contacts, both, notices, whole, calls_per_tick,
/// contacts_per_tick, state_hash}
nlohmann::json record_of(const WholeCount &count);

/// Has every contender moved the scene in the same way? Spaces that lose a contact, or add one, change the motion.
bool same_states(const std::vector<WholeCount> &counts);

/// The count of this space in this scene; null when there is none.
const WholeCount *find(const std::vector<WholeCount> &counts, const std::string &scene, int objects,
                       const std::string &space);

/// A table of counts, scene by scene.
void print(std::ostream &out, const std::vector<WholeCount> &counts);
} // namespace ode_predictive_space::benchmarks

#endif
