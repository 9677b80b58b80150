#ifndef ODE_PREDICTIVE_SPACE_RECORDING_STATE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_STATE_H

#include <array>
#include <cstdint>

#include <ode/common.h>

namespace ode_predictive_space::recording
{
using Pose = std::array<dReal, 12>; ///< position, rotation by rows

struct BodyState
{
    std::uint8_t flags = 0;
    Pose pose{};
    std::array<dReal, 6> velocity{}; ///< linear, angular
};

struct SpaceState
{
    std::int32_t sublevel = 0;
    std::int32_t min_level = 0, max_level = 0; ///< of a hash space
};

struct SpaceService
{
    std::uint8_t predictive =
        0; ///< 1 + its proximity (dPredictiveProximityBox, ...); 0: a space of ODE, with unknown notices
    std::uint8_t is_substitute = 0; ///< 1: predictive, in the place of a space of ODE that the program made

    bool is_predictive_in_program() const { return predictive && !is_substitute; }
};

struct GeomState
{
    std::uint8_t geom_class = 0; ///< or stand_in, fixed_heightfield; what a transform holds has its class
    std::uint8_t flags = 0;
    std::uint8_t has_offset = 0;
    SpaceState space;
    SpaceService service;
    std::uint32_t parent = 0; ///< id + 1
    std::uint32_t data = 0;   ///< id of a mesh, convex or heightfield
    std::uint32_t body = 0;   ///< id + 1
    std::array<std::uint64_t, 2> bits{};
    std::array<dReal, 6> size{};
    Pose offset{}, pose{};
};

/// A geom on a body, without an offset from it, has the pose of the body.
bool has_own_pose(const GeomState &state);

BodyState state_of(dBodyID body);

/// Leaves parent, data, body and service at 0. If the geom's data cannot be recorded, the caller must call make_stand_in().
GeomState state_of(dGeomID geom);

/// The geom to record: the geom inside a transform, if its class can be recorded, otherwise the geom itself.
dGeomID shape_of(dGeomID geom);

void make_stand_in(dGeomID geom, GeomState &state);

/// The fields in which two states differ, bit by bit: a mask of body_field or geom_field.
std::uint16_t difference(const BodyState &before, const BodyState &now);
std::uint16_t difference(const GeomState &before, const GeomState &now);
} // namespace ode_predictive_space::recording

#endif
