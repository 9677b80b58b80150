// The pairs that a space must report, by comparing all geoms with each other.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SOAK_PAIR_ORACLE_H
#define ODE_PREDICTIVE_SPACE_TESTS_SOAK_PAIR_ORACLE_H

#include "demos/worlds/pair_list.h"

namespace ode_predictive_space::soak
{
/// Two geoms, in the order of their numbers.
struct GeomPair
{
    worlds::IndexPair numbers;
    dGeomID first, second;
};

/// The pairs of geoms for which dSpaceCollide() must call the callback: bounding boxes overlap, bits match, bodies differ. They
/// are in ascending order of their numbers. @param geoms those in the space, with different numbers.
std::vector<GeomPair> overlapping_pairs(const std::vector<dGeomID> &geoms);

/// As above, for dSpaceCollide2() of each query with the space.
std::vector<GeomPair> pairs_of_queries(const std::vector<dGeomID> &queries, const std::vector<dGeomID> &geoms);
} // namespace ode_predictive_space::soak

#endif
