#include "tests/benchmarks/instructions/whole_counts.h"

#include "demos/runs/table.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

std::string ratio_text(double one, double other)
{
    return other > 0 ? fixed(one / other, 3) : "-";
}
} // namespace

nlohmann::json record_of(const WholeCount &count)
{
    nlohmann::json record = record_of(count, "whole ticks");
    record.update({{"collide", count.collide},
                   {"contacts", count.contacts},
                   {"both", count.both()},
                   {"notices", count.notices},
                   {"whole", count.whole},
                   {"calls_per_tick", count.calls_per_tick},
                   {"contacts_per_tick", count.contacts_per_tick},
                   {"state_hash", count.state_hash}});
    return record;
}

bool same_states(const std::vector<WholeCount> &counts)
{
    return std::all_of(counts.begin(), counts.end(), [&](const WholeCount &count) {
        const WholeCount *first = &*std::find_if(counts.begin(), counts.end(), [&](const WholeCount &other) {
            return other.scene == count.scene && other.objects == count.objects;
        });
        return count.state_hash == first->state_hash && count.contacts_per_tick == first->contacts_per_tick;
    });
}

const WholeCount *find(const std::vector<WholeCount> &counts, const std::string &scene, int objects,
                       const std::string &space)
{
    const auto found = std::find_if(counts.begin(), counts.end(), [&](const WholeCount &count) {
        return count.scene == scene && count.objects == objects && count.space == space;
    });
    return found == counts.end() ? nullptr : &*found;
}

void print(std::ostream &out, const std::vector<WholeCount> &counts)
{
    out << "Instructions per whole tick; \"of boxes\" is beside predictive-box\n\n";
    Table table({"scene", "space", "collide", "dCollide", "sum", "of boxes", "notices", "whole tick", "of boxes",
                 "calls", "contacts", "ticks", "hash of states"});
    for (const WholeCount &count : counts)
    {
        const WholeCount *boxes = find(counts, count.scene, count.objects, "predictive-box");
        table.add({title_of(count), count.space, fixed(count.collide, 1), fixed(count.contacts, 1),
                   fixed(count.both(), 1), ratio_text(count.both(), boxes != nullptr ? boxes->both() : 0),
                   fixed(count.notices, 1), fixed(count.whole, 1),
                   ratio_text(count.whole, boxes != nullptr ? boxes->whole : 0), fixed(count.calls_per_tick, 2),
                   fixed(count.contacts_per_tick, 2), grouped(static_cast<std::uint64_t>(count.ticks)),
                   count.state_hash});
    }
    table.print(out);
    out << '\n';
}
} // namespace ode_predictive_space::benchmarks
