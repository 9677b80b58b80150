// The fields of a body and of a geom, in the order in which their records have them.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_FIELDS_H
#define ODE_PREDICTIVE_SPACE_RECORDING_FIELDS_H

#include <cstddef>

#include "ode_predictive_space/recording/format.h"
#include "ode_predictive_space/recording/state.h"

namespace ode_predictive_space::recording
{
/// Calls visit(address, size) for the fields of a BodyState, const or not, that the mask has.
template <typename State, typename Visit> void visit_body_fields(State &state, std::uint16_t fields, Visit visit)
{
    if (fields & body_field::flags)
        visit(&state.flags, sizeof state.flags);
    if (fields & body_field::pose)
        visit(&state.pose, sizeof state.pose);
    if (fields & body_field::velocity)
        visit(&state.velocity, sizeof state.velocity);
}

/// As visit_body_fields(), for a GeomState whose class is set: the class determines how many numbers its size has.
template <typename State, typename Visit> void visit_geom_fields(State &state, std::uint16_t fields, Visit visit)
{
    const auto visit_if = [&](std::uint16_t field, auto &value, std::size_t size) {
        if (fields & field)
            visit(&value, size);
    };
    visit_if(geom_field::space, state.space, sizeof state.space);
    visit_if(geom_field::parent, state.parent, sizeof state.parent);
    visit_if(geom_field::bits, state.bits, sizeof state.bits);
    visit_if(geom_field::flags, state.flags, sizeof state.flags);
    visit_if(geom_field::size, state.size, sizeof(dReal) * static_cast<std::size_t>(size_count(state.geom_class)));
    visit_if(geom_field::data, state.data, sizeof state.data);
    visit_if(geom_field::body, state.body, sizeof state.body);
    visit_if(geom_field::offset, state.has_offset, sizeof state.has_offset);
    visit_if(geom_field::offset, state.offset, sizeof state.offset);
    visit_if(geom_field::pose, state.pose, sizeof state.pose);
    visit_if(geom_field::service, state.service, sizeof state.service);
}
} // namespace ode_predictive_space::recording

#endif
