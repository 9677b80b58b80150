#include "ode_predictive_space/recording/own_space.h"

#include <ode/collision.h>

namespace ode_predictive_space::recording
{
namespace
{

GeomState first_space(const Recording &recording)
{
    for (const Record &record : recording.records())
        if (record.kind == RecordKind::geom && recording.id(record) == recording.first_space())
            return recording.geom(record).state;
    GeomState none;
    none.geom_class = dHashSpaceClass;
    return none;
}
} // namespace

SpaceKind kind_of_own_space(const Recording &recording)
{
    return own_kind(first_space(recording));
}

SpaceKind kind_of_recorded_space(const Recording &recording)
{
    const GeomState space = first_space(recording);
    return space.service.predictive ? predictive_kind(space.service.predictive - 1) : own_kind(space);
}

std::string name_of_own_space(const Recording &recording)
{
    const std::string name = name_of(kind_of_own_space(recording));
    return first_space(recording).service.is_predictive_in_program() ? "predictive, by " + name : name;
}

std::string unknown_notices(const Recording &recording)
{
    if (first_space(recording).service.predictive)
        return "";
    const char *const why =
        recording.version() == 1 ? "The recording has the first format" : "Spaces of ODE were recorded";
    return std::string(why) +
           ", which does not say how often poses were set: one notice is replayed for each geom that has moved.";
}
} // namespace ode_predictive_space::recording
