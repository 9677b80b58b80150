#include "ode_predictive_space/preload/settings.h"

#include <sstream>

#include <ode/collision.h>

#include "ode_predictive_space/predictive_space.h"

namespace ode_predictive_space::preload
{
namespace
{
// Plain data: the names are still wanted when objects have been destroyed, at exit.
struct NamedClass
{
    const char *name;
    int space_class;
};

constexpr NamedClass space_classes[] = {{"hash", dHashSpaceClass},
                                        {"quadtree", dQuadTreeSpaceClass},
                                        {"sap", dSweepAndPruneSpaceClass},
                                        {"simple", dSimpleSpaceClass}};

// Simple spaces are what programs use for tiny groups.
std::set<int> replaced_by_default()
{
    return {dHashSpaceClass, dQuadTreeSpaceClass, dSweepAndPruneSpaceClass};
}

// Adds the classes that a word of the list stands for.
bool add_classes(const std::string &word, std::set<int> &classes)
{
    bool known = word == "none";
    for (const NamedClass &each : space_classes)
        if (word == each.name || word == "all")
        {
            classes.insert(each.space_class);
            known = true;
        }
    return known;
}

class Reader
{
public:
    Reader(const std::function<const char *(const char *)> &variable, std::vector<std::string> &complaints)
        : variable_(variable), complaints_(complaints)
    {}

    std::string value(const char *name) const
    {
        const char *found = variable_(name);
        return found ? found : "";
    }

    std::set<int> classes(const char *name)
    {
        const std::string text = value(name);
        std::set<int> chosen;
        std::istringstream words(text);
        for (std::string word; std::getline(words, word, ',');)
            if (!add_classes(word, chosen))
            {
                complain(name, word, "hash, quadtree, sap, simple, all or none", "hash,quadtree,sap");
                return replaced_by_default();
            }
        return text.empty() ? replaced_by_default() : chosen;
    }

    int proximity(const char *name)
    {
        const std::string text = value(name);
        if (text == "sphere")
            return dPredictiveProximitySphere;
        if (text == "shape")
            return dPredictiveProximityShape;
        if (!text.empty() && text != "box")
            complain(name, text, "box, sphere or shape", "box");
        return dPredictiveProximityBox;
    }

    bool yes(const char *name)
    {
        const std::string text = value(name);
        if (!text.empty() && text != "0" && text != "1")
            complain(name, text, "0 or 1", "0");
        return text == "1";
    }

private:
    void complain(const char *name, const std::string &word, const char *known, const char *instead)
    {
        complaints_.push_back(std::string(name) + ": '" + word + "' is not " + known + "; using " + instead);
    }

    const std::function<const char *(const char *)> &variable_;
    std::vector<std::string> &complaints_;
};
} // namespace

Settings read_settings(const std::function<const char *(const char *)> &variable, std::vector<std::string> &complaints)
{
    Reader reader(variable, complaints);
    Settings settings;
    settings.replaced = reader.classes("ODE_PREDICTIVE_SPACE");
    settings.proximity = reader.proximity("ODE_PREDICTIVE_PROXIMITY");
    const std::string stats = reader.value("ODE_PREDICTIVE_STATS");
    settings.stats = !stats.empty() && stats != "0";
    settings.stats_file = settings.stats && stats != "1" ? stats : "";
    settings.counted = !reader.value("ODE_PREDICTIVE_COUNTS").empty();
    settings.compare = reader.yes("ODE_PREDICTIVE_COMPARE");
    settings.trace_file = reader.value("ODE_PREDICTIVE_TRACE");
    return settings;
}

const char *name_of_space_class(int space_class)
{
    for (const NamedClass &each : space_classes)
        if (each.space_class == space_class)
            return each.name;
    return "unknown";
}
} // namespace ode_predictive_space::preload
