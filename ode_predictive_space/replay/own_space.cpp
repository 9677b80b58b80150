#include "ode_predictive_space/replay/own_space.h"

#include <ode/collision.h>

#include "ode_predictive_space/replay/space_kind.h"

namespace ode_predictive_space::replay
{
namespace
{
using history::GeomState;
using history::Record;
using history::Recording;
using history::RecordKind;

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

std::string name_of_own_space(const Recording &recording)
{
    const GeomState space = first_space(recording);
    if (space.service.predictive)
        return std::string("predictive, by ") + name_of(predictive_kind(space.service.predictive - 1));
    switch (space.geom_class)
    {
    case dSimpleSpaceClass:
        return "simple";
    case dQuadTreeSpaceClass:
        return "quadtree";
    case dSweepAndPruneSpaceClass:
        return "sap";
    default:
        return "hash";
    }
}

std::string unknown_notices(const Recording &recording)
{
    if (first_space(recording).service.counts_notices)
        return "";
    const char *const why =
        recording.version() == 1 ? "The recording has the first format" : "Spaces of ODE were recorded";
    return std::string(why) +
           ", which does not say how often poses were set: one notice is replayed for each geom that has moved.";
}
} // namespace ode_predictive_space::replay
