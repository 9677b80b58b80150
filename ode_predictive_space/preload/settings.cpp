#include "ode_predictive_space/preload/settings.h"

#include <sstream>

#include <ode/collision.h>

#include "ode_predictive_space/predictive_space.h"

namespace ode_predictive_space::preload
{
namespace
{
// Plain data, because the names are used at exit, when objects have been destroyed.
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

    std::uint64_t bytes(const char *name, std::uint64_t otherwise)
    {
        const std::string text = value(name);
        const std::uint64_t bytes = bytes_named(text);
        if (!text.empty() && bytes == 0)
            complain(name, text, "a number of bytes, such as 100M", "256M");
        return bytes ? bytes : otherwise;
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

std::uint64_t bytes_named(const std::string &text)
{
    constexpr std::uint64_t most = std::uint64_t{1} << 60;
    std::uint64_t bytes = 0;
    std::size_t digits = 0;
    for (; digits < text.size() && text[digits] >= '0' && text[digits] <= '9' && bytes <= most; ++digits)
        bytes = 10 * bytes + static_cast<std::uint64_t>(text[digits] - '0');
    const std::string unit = text.substr(digits);
    const unsigned shift = unit == "K" ? 10 : unit == "M" ? 20 : unit == "G" ? 30 : 0;
    const bool known = unit.empty() || shift > 0;
    return known && bytes <= most >> shift ? bytes << shift : 0;
}

Settings read_settings(const std::function<const char *(const char *)> &variable, std::vector<std::string> &complaints)
{
    Reader reader(variable, complaints);
    Settings settings;
    settings.replaced = reader.classes("ODE_PREDICTIVE_SPACE");
    settings.proximity = reader.proximity("ODE_PREDICTIVE_PROXIMITY");
    const std::string stats = reader.value("ODE_PREDICTIVE_STATS");
    settings.stats = !stats.empty() && stats != "0";
    settings.stats_file = settings.stats && stats != "1" ? stats : "";
    settings.trace_file = reader.value("ODE_PREDICTIVE_TRACE");
    settings.record_file = reader.value("ODE_PREDICTIVE_RECORD");
    settings.record_limit = reader.bytes("ODE_PREDICTIVE_RECORD_LIMIT", default_record_limit);
    return settings;
}

bool is_name_of_spaces(const std::string &word)
{
    std::set<int> classes;
    return add_classes(word, classes);
}

const char *name_of_space_class(int space_class)
{
    for (const NamedClass &each : space_classes)
        if (each.space_class == space_class)
            return each.name;
    return "unknown";
}
} // namespace ode_predictive_space::preload
