#include "tests/benchmarks/contenders/contenders.h"

#include "tests/benchmarks/contenders/brute_force.h"
#include "tests/benchmarks/contenders/plain_sweep.h"
#ifdef ODE_PREDICTIVE_SPACE_HAVE_BULLET
#include "tests/benchmarks/contenders/bullet_space.h"
#endif

#include <functional>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using worlds::Contender;
using worlds::SpaceKind;
using worlds::WorldFactory;

struct Entry
{
    std::string name;
    std::function<std::unique_ptr<Contender>(const WorldFactory &)> make;
};

Entry entry_of(SpaceKind kind)
{
    return {space_name(kind), [kind](const WorldFactory &factory) { return worlds::make_contender(kind, factory); }};
}

const std::vector<Entry> &entries()
{
    static const std::vector<Entry> all = {
        entry_of(SpaceKind::predictive),
        entry_of(SpaceKind::predictive_by_spheres),
        entry_of(SpaceKind::predictive_by_shapes),
        entry_of(SpaceKind::simple),
        entry_of(SpaceKind::hash),
        entry_of(SpaceKind::quadtree),
        entry_of(SpaceKind::sweep_and_prune),
        {"brute", [](const WorldFactory &) { return make_brute_force(); }},
        {"sweep", [](const WorldFactory &) { return make_plain_sweep(); }},
#ifdef ODE_PREDICTIVE_SPACE_HAVE_BULLET
        {"bullet-dbvt", [](const WorldFactory &) { return make_bullet_dbvt(); }},
        {"bullet-sap", [](const WorldFactory &factory) { return make_bullet_sap(factory); }},
#endif
    };
    return all;
}
} // namespace

const std::vector<std::string> &contender_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        for (const Entry &entry : entries())
        {
            result.push_back(entry.name);
        }
        return result;
    }();
    return names;
}

std::unique_ptr<Contender> make_contender(const std::string &name, const WorldFactory &factory)
{
    const std::string full_name = name == "predictive" ? space_name(SpaceKind::predictive) : name;
    for (const Entry &entry : entries())
    {
        if (entry.name == full_name)
        {
            return entry.make(factory);
        }
    }
    throw std::invalid_argument("there is no contender named \"" + name + "\"");
}

bool is_space(const std::string &name)
{
    return name.rfind("predictive", 0) == 0 || name == "simple" || name == "hash" || name == "quadtree" ||
           name == "sap";
}
} // namespace ode_predictive_space::benchmarks
