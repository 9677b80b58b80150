#include "tests/benchmarks/contenders/contenders.h"

#include "tests/benchmarks/contenders/brute_force.h"
#include "tests/benchmarks/contenders/plain_sweep.h"
#ifdef ODE_PREDICTIVE_SPACE_HAVE_BULLET
#include "tests/benchmarks/contenders/bullet_space.h"
#endif

#include <functional>
#include <map>

namespace ode_predictive_space::benchmarks
{
namespace
{
using worlds::WorldFactory;

/// The contenders that are not spaces.
const std::map<std::string, std::function<std::unique_ptr<Contender>(const WorldFactory &)>> others = {
    {"brute", [](const WorldFactory &) { return make_brute_force(); }},
    {"sweep", [](const WorldFactory &) { return make_plain_sweep(); }},
#ifdef ODE_PREDICTIVE_SPACE_HAVE_BULLET
    {"bullet-dbvt", [](const WorldFactory &) { return make_bullet_dbvt(); }},
    {"bullet-sap", [](const WorldFactory &factory) { return make_bullet_sap(factory); }},
#endif
};
} // namespace

std::vector<std::string> contender_names()
{
    std::vector<std::string> names = worlds::all_spaces();
    for (const auto &[name, make] : others)
        names.push_back(name);
    return names;
}

std::unique_ptr<Contender> make_contender(const std::string &name, const WorldFactory &factory)
{
    if (const auto other = others.find(name); other != others.end())
        return other->second(factory);
    return std::make_unique<Contender>(worlds::OwnedSpace(worlds::make_space(name, factory)));
}

bool is_space(const std::string &contender)
{
    return others.count(contender) == 0;
}
} // namespace ode_predictive_space::benchmarks
