#include "tests/benchmarks/rows.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
using worlds::ticks_between_events;
using worlds::ticks_of_life;

void add_parts(std::vector<Row> &all, const Row &row, int half_seconds)
{
    constexpr const char *names[] = {"0.0s", "0.5s", "1.0s", "1.5s", "2.0s", "2.5s"};
    const int per_part = static_cast<int>(0.5 / worlds::world_named(row.world).step + 0.5);
    for (int i = 0; i < half_seconds; ++i)
        all.push_back({row.world, row.objects, {i * per_part, per_part}, {}, names[i]});
}

const std::vector<Row> &scenes()
{
    static const std::vector<Row> all = {
        {"mix", 40, {}, {200, 1000}},
        {"mix", 100, {200, 16000}},
        {"mix", 1000, {100, 3000}},
        {"mix", 10000, {100, 500}},
        {"gas", 100, {200, 10000}, {200, 1000}},
        {"gas", 1000, {100, 3000}, {100, 500}},
        {"gas", 10000, {100, 1000}, {100, 300}},
        {"gas", 100000, {60, 200}},
        {"game", 100, {200, 10000}, {200, 1000}},
        {"game", 1000, {100, 3000}, {100, 300}},
        {"game", 10000, {50, 300}, {50, 20}},
        {"pile", 500, {100, 1000}, {50, 100}},
        {"stack", 1000, {100, 1200}, {100, 400}}, // the ball is thrown every 400 ticks
        {"terrain", 5000, {50, 500}, {50, 100}},
        {"teleport", 10, {}, {100, 500}},
        {"teleport", 100, {}, {50, 200}},
        {"teleport", 1000, {50, 1000}, {50, 100}},
        {"still", 10000, {20, 300}, {20, 100}},
        {"dart", 1000, {100, 3000}, {50, 100}},
        {"explosion", 1000, {100, 1200}, {100, 400}}, // an explosion every 200 ticks
        {"churn", 1000, {100, 1000}},
    };
    return all;
}

const std::vector<Row> &stepped_scenes()
{
    static const std::vector<Row> all = {
        {"gas_stepped", 100, {200, 10000}},
        {"gas_stepped", 1000, {100, 3000}},
        {"gas_stepped", 10000, {100, 1000}},
        {"game_stepped", 100, {200, 10000}},
        {"game_stepped", 1000, {100, 3000}},
        {"game_stepped", 10000, {100, 1000}},
        {"classes_stepped", 1000, {100, 1000}},
        {"pile", 100, {100, 3000}},
        {"pile", 2000, {100, 400}},
        {"terrain_stepped", 1000, {100, 1000}},
        {"teleport_stepped", 1000, {50, 1000}},
        {"dart", 3000, {100, 1000}},
        {"dart", 10000, {100, 1000}},
    };
    return all;
}

/// Worlds as programs have them. For a heap, the first half second of its fall is counted, and its rest after 1.5 s.
const std::vector<Row> &programs()
{
    static const std::vector<Row> all = {
        {"floor", 100, {100, 2000}, {100, 200}},
        {"floor", 500, {100, 1000}, {100, 100}},
        {"floor", 2000, {50, 300}, {50, 20}},
        {"floor_50", 500, {100, 1000}, {100, 100}},
        {"ragdolls", 20, {100, 1000}, {100, 100}},
        {"chain", 1, {100, 5000}, {100, 300}},
        {"shelves", 1000, {50, 500}, {50, 50}},
        {"shelves", 10000, {50, 200}, {20, 10}},
        {"shelves_mesh", 1000, {50, 500}, {50, 50}},
        {"shelves_mesh", 10000, {50, 200}, {20, 10}},
        {"heap", 100, {0, 600}, {0, 100}},
        {"heap", 500, {0, 400}, {0, 100}},
        {"heap", 2000, {0, 400}, {0, 100}},
        {"heap_lies", 100, {}, {300, 100}},
        {"heap_lies", 500, {}, {300, 50}},
        {"heap_lies", 2000, {}, {300, 20}},
        {"heap_50", 500, {0, 400}, {0, 100}},
        {"drones", 300, {50, 1000}, {50, 100}},
        {"drones", 1000, {50, 500}, {50, 30}},
        {"room", 1000, {300, 500}, {250, 30}}, // the tree of the room is ready by then
        {"hills", 1000, {300, 500}, {250, 30}},
        {"city", 100, {50, 500}, {50, 50}},
        {"rain", 1000, {50, 600}, {100, 100}},
        {"frames_0", 1000, {100, 600}, {100, 40}},
        {"frames_20", 1000, {100, 600}, {100, 40}},
        {"frames_50", 1000, {100, 600}, {100, 40}},
        {"frames_80", 1000, {100, 600}, {100, 40}},
        {"frames_set_0", 1000, {100, 600}, {100, 40}},
        {"frames_set_20", 1000, {100, 600}, {100, 40}},
        {"frames_set_50", 1000, {100, 600}, {100, 40}},
        {"frames_set_80", 1000, {100, 600}, {100, 40}},
        {"many", 2, {}, {0, ticks_of_life}},
        {"many", 8, {}, {0, ticks_of_life}},
        {"many", 17, {0, 100 * ticks_of_life}, {0, ticks_of_life}},
        {"many", 32, {}, {0, ticks_of_life}},
        {"nested", 22, {50, 1000}, {50, 100}},
        {"nested_empty", 100, {10, 500}, {10, 20}},
        {"lidar", 1000, {5, 50}, {3, 2}},
        {"lidar_nested", 1000, {5, 50}, {3, 2}},
        {"moon", 200, {100, 1000}, {100, 100}},
        {"conveyor", 200, {60, 600}, {60, 60}},
    };
    return all;
}

/// Rows for ticks in which everything moves at once or is new, and for each of the two ticks after these.
void add_events(std::vector<Row> &all)
{
    for (int later = 0; later < 3; ++later)
    {
        const std::string name = later == 0 ? "" : "_" + std::to_string(later);
        const Ticks events = {ticks_between_events + later, 3, ticks_between_events};
        all.push_back({"reset" + name, 100, {}, events});
        all.push_back({"recentre" + name, 1000, {}, events});
        all.push_back({"first" + name, 1000, {}, {later, 1}});
    }
}
} // namespace

const std::vector<Row> &rows()
{
    static const std::vector<Row> all = [] {
        std::vector<Row> result = scenes();
        result.insert(result.end(), stepped_scenes().begin(), stepped_scenes().end());
        result.insert(result.end(), programs().begin(), programs().end());
        add_events(result);
        add_parts(result, {"settling", 500}, 4);
        add_parts(result, {"heap", 100}, 6);
        add_parts(result, {"heap", 500}, 4);
        add_parts(result, {"heap", 2000}, 4);
        return result;
    }();
    return all;
}
} // namespace ode_predictive_space::benchmarks
