#include "ode_predictive_space/recording/replay.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iterator>
#include <memory>
#include <set>

#include <ode/ode.h>

#include "ode_predictive_space/recording/child.h"
#include "ode_predictive_space/recording/stage.h"

namespace ode_predictive_space::recording
{
// By their names callgrind knows what to count; as they are exported, also in a program without symbols.
extern "C" {
__attribute__((noinline, visibility("default"))) void counted_changes(Stage &stage, const Record &record)
{
    stage.apply(record);
}

__attribute__((noinline, visibility("default"))) void counted_collide(Stage &stage, const Record &record, void *data,
                                                                      dNearCallback *callback)
{
    stage.ask(record, data, callback);
}

__attribute__((noinline, visibility("default"))) void counted_end(std::unique_ptr<Stage> &stage)
{
    stage.reset();
}
}

namespace
{
using IdPair = std::pair<std::uint32_t, std::uint32_t>;
using IdPairs = std::vector<IdPair>;

bool is_event(const Record &record)
{
    return record.kind == RecordKind::collide || record.kind == RecordKind::collide2;
}

void add_pair(void *pairs, dGeomID first, dGeomID second)
{
    static_cast<IdPairs *>(pairs)->push_back(std::minmax(Stage::id_of(first), Stage::id_of(second)));
}

void count_pair(void *count, dGeomID /*first*/, dGeomID /*second*/)
{
    ++*static_cast<std::uint32_t *>(count);
}

constexpr int most_contacts = 8; // of a dCollide()

void find_contacts(void * /*data*/, dGeomID first, dGeomID second)
{
    dContactGeom contacts[most_contacts];
    if (!dGeomIsSpace(first) && !dGeomIsSpace(second))
        dCollide(first, second, most_contacts, contacts, sizeof contacts[0]);
}

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_time()
{
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Goes through the records: `change` for each that is no event, `event` with its number for each that is one, until it says no.
template <typename Change, typename Event> void walk(const Recording &recording, Change change, Event event)
{
    std::size_t number = 0;
    for (const Record &record : recording.records())
        if (!is_event(record))
            change(record);
        else if (!event(record, number++))
            return;
}

IdPairs pairs_of(Stage &stage, const Record &record)
{
    IdPairs pairs;
    stage.ask(record, &pairs, add_pair);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

bool is_bounded(dGeomID geom)
{
    dReal box[6];
    dGeomGetAABB(geom, box);
    return !dGeomIsSpace(geom) && std::none_of(box, box + 6, [](dReal side) { return std::isinf(side); });
}

EventPairs summary_of(const Stage &stage, const IdPairs &pairs)
{
    EventPairs summary{static_cast<std::uint32_t>(pairs.size()), 0, 0, 0};
    for (const IdPair &pair : pairs)
    {
        const std::uint64_t hash = hash_of_pair(pair.first, pair.second);
        summary.hash += hash;
        if (is_bounded(stage.geom(pair.first)) && is_bounded(stage.geom(pair.second)))
            continue;
        ++summary.unbounded;
        summary.hash_of_unbounded += hash;
    }
    return summary;
}

bool can_be_collided(const Stage &stage, const IdPair &pair)
{
    return !stage.is_stand_in(pair.first) && !stage.is_stand_in(pair.second) && !dGeomIsSpace(stage.geom(pair.first)) &&
           !dGeomIsSpace(stage.geom(pair.second));
}

bool touch(const Stage &stage, const IdPair &pair)
{
    dContactGeom contacts[most_contacts];
    return dCollide(stage.geom(pair.first), stage.geom(pair.second), most_contacts, contacts, sizeof contacts[0]) > 0;
}

struct ByPairs
{
    std::uint64_t events, lost_contacts, strange;
};

// Beside the spaces that leave out pairs, spaces by boxes tell which ones.
void find_left_out(const Stage &boxes, const IdPairs &expected, const IdPairs &found, ByPairs &result)
{
    IdPairs left_out, strange;
    std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(), std::back_inserter(left_out));
    std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(), std::back_inserter(strange));
    result.strange += strange.size();
    for (const IdPair &pair : left_out)
        result.lost_contacts += !can_be_collided(boxes, pair) || touch(boxes, pair);
}

void find_pairs_here(const Recording &recording, SpaceKind kind, const SharedArray<EventPairs> &events, ByPairs &result)
{
    Stage stage(recording, kind);
    const std::unique_ptr<Stage> boxes =
        leaves_out_pairs(kind) ? std::make_unique<Stage>(recording, SpaceKind::box) : nullptr;
    walk(
        recording,
        [&](const Record &record) {
            stage.apply(record);
            if (boxes)
                boxes->apply(record);
        },
        [&](const Record &record, std::size_t number) {
            const IdPairs found = pairs_of(stage, record);
            events[number] = summary_of(stage, found);
            if (boxes)
                find_left_out(*boxes, pairs_of(*boxes, record), found, result);
            result.events = number + 1;
            return true;
        });
}
} // namespace

Pairs find_pairs(const Recording &recording, SpaceKind kind)
{
    const SharedArray<EventPairs> events(recording.events().size());
    const SharedArray<ByPairs> result(1);
    Pairs pairs;
    pairs.failure = do_in_child([&] { find_pairs_here(recording, kind, events, result[0]); });
    for (std::size_t i = 0; i < result[0].events; ++i)
        pairs.events.push_back(events[i]);
    pairs.lost_contacts = result[0].lost_contacts;
    pairs.strange = result[0].strange;
    return pairs;
}

DifferentPairs differing_pairs(const Recording &recording, SpaceKind first, SpaceKind second, std::size_t event)
{
    struct Shared
    {
        std::uint64_t count;
        std::uint32_t pairs[16][2];
        bool first_has[16];
    };
    const SharedArray<Shared> shared(1);
    do_in_child([&] {
        Stage one(recording, first), other(recording, second);
        walk(
            recording,
            [&](const Record &record) {
                one.apply(record);
                other.apply(record);
            },
            [&](const Record &record, std::size_t number) {
                const IdPairs in_first = pairs_of(one, record), in_second = pairs_of(other, record);
                if (number != event)
                    return true;
                IdPairs differing;
                std::set_symmetric_difference(in_first.begin(), in_first.end(), in_second.begin(), in_second.end(),
                                              std::back_inserter(differing));
                for (const IdPair &pair : differing)
                    if (Shared &result = shared[0]; result.count < 16)
                    {
                        result.first_has[result.count] = std::binary_search(in_first.begin(), in_first.end(), pair);
                        result.pairs[result.count][0] = pair.first;
                        result.pairs[result.count++][1] = pair.second;
                    }
                return false;
            });
    });
    DifferentPairs differing;
    for (std::uint64_t i = 0; i < shared[0].count; ++i)
        differing.push_back({{shared[0].pairs[i][0], shared[0].pairs[i][1]}, shared[0].first_has[i]});
    return differing;
}

namespace
{
struct ByClock
{
    std::uint64_t events;
    double processor_time;
};

struct ByClockOfEvent
{
    float seconds, notices;
    std::uint32_t callbacks;
};

void add_up(Cost &cost)
{
    cost.collides = cost.notices = 0;
    cost.callbacks = 0;
    for (std::size_t i = 0; i < cost.events; ++i)
    {
        cost.collides += static_cast<double>(cost.seconds[i]);
        cost.notices += static_cast<double>(cost.seconds_of_notices[i]);
        cost.callbacks += cost.callbacks_of[i];
    }
}
} // namespace

Cost without(const Cost &none, Cost cost)
{
    cost.notices = std::max(0.0, cost.notices - none.notices);
    cost.processor_time -= none.processor_time;
    return cost;
}

namespace
{
void measure_here(const Recording &recording, SpaceKind kind, std::size_t most_events, double most_seconds,
                  const SharedArray<ByClockOfEvent> &events, ByClock &result)
{
    Stage stage(recording, kind);
    const double begin = now();
    double told = begin; // since when there are notices
    double processor_begin = 0;
    walk(
        recording, [&](const Record &record) { stage.apply(record); },
        [&](const Record &record, std::size_t number) {
            std::uint32_t callbacks = 0;
            const double start = now();
            if (number >= most_events || start - begin > most_seconds)
                return false;
            if (number == 0)
                processor_begin = processor_time();
            stage.ask(record, &callbacks, count_pair);
            const double end = now();
            // What is before the first is the making of all geoms.
            const double notices = number > 0 ? start - told : 0;
            result.events = number + 1;
            events[number] = {static_cast<float>(end - start), static_cast<float>(notices), callbacks};
            told = now();
            return true;
        });
    result.processor_time = result.events > 0 ? processor_time() - processor_begin : 0;
}
} // namespace

Cost measure(const Recording &recording, SpaceKind kind, std::size_t most_events, double most_seconds)
{
    const SharedArray<ByClockOfEvent> events(recording.events().size());
    const SharedArray<ByClock> result(1);
    Cost cost;
    cost.failure = do_in_child([&] { measure_here(recording, kind, most_events, most_seconds, events, result[0]); });
    cost.events = result[0].events;
    cost.processor_time = result[0].processor_time;
    for (std::size_t i = 0; i < cost.events; ++i)
    {
        cost.seconds.push_back(events[i].seconds);
        cost.seconds_of_notices.push_back(events[i].notices);
        cost.callbacks_of.push_back(events[i].callbacks);
    }
    add_up(cost);
    return cost;
}

void take_least(const Cost &again, Cost &cost)
{
    for (std::size_t event = 0; event < std::min(again.events, cost.events); ++event)
    {
        cost.seconds[event] = std::min(cost.seconds[event], again.seconds[event]);
        cost.seconds_of_notices[event] = std::min(cost.seconds_of_notices[event], again.seconds_of_notices[event]);
    }
    add_up(cost);
}

Cost measure_repeatedly(const Recording &recording, SpaceKind kind, std::size_t most_events, double most_seconds)
{
    constexpr int more_times = 2;
    Cost least = measure(recording, kind, most_events, most_seconds);
    for (int i = 0; i < more_times && least.failure.empty(); ++i)
        take_least(measure(recording, kind, least.events, 1e9), least);
    return least;
}

namespace
{
struct Judgement
{
    std::uint64_t all, nothing, unknown;
    double seconds;
};

// @param by_shape those pairs that spaces by shape have; in order, as the others.
void judge_pairs(const Stage &stage, const IdPairs &pairs, const IdPairs &by_shape, Judgement &result)
{
    result.all += pairs.size();
    for (const IdPair &pair : pairs)
    {
        if (!can_be_collided(stage, pair))
        {
            ++result.unknown;
            continue;
        }
        const double start = now();
        if (touch(stage, pair))
            continue;
        const double end = now();
        ++result.nothing;
        if (!std::binary_search(by_shape.begin(), by_shape.end(), pair))
            result.seconds += end - start;
    }
}
} // namespace

Callbacks judge_callbacks(const Recording &recording, std::size_t most_events, double most_seconds)
{
    const SharedArray<Judgement> result(1);
    Callbacks callbacks;
    callbacks.failure = do_in_child([&] {
        Stage boxes(recording, SpaceKind::box), shapes(recording, SpaceKind::shape);
        const double begin = now();
        walk(
            recording,
            [&](const Record &record) {
                boxes.apply(record);
                shapes.apply(record);
            },
            [&](const Record &record, std::size_t number) {
                if (number >= most_events || now() - begin > most_seconds)
                    return false;
                judge_pairs(boxes, pairs_of(boxes, record), pairs_of(shapes, record), result[0]);
                return true;
            });
    });
    callbacks.all = result[0].all;
    callbacks.nothing = result[0].nothing;
    callbacks.unknown = result[0].unknown;
    callbacks.seconds_spared = result[0].seconds;
    return callbacks;
}

// The first life in a process also pays for what is made once.
void live_once(const Recording &recording, SpaceKind kind)
{
    Stage stage(recording, kind);
    walk(
        recording, [&](const Record &record) { stage.apply(record); },
        [&](const Record &record, std::size_t) {
            std::uint32_t callbacks = 0;
            stage.ask(record, &callbacks, count_pair);
            return true;
        });
}

void replay_to_be_counted(const Recording &recording, SpaceKind kind, const CountedEvents &events)
{
    if (events.whole_life)
        live_once(recording, kind);
    // What the whole life costs without a space is known from geoms in none.
    auto stage = std::make_unique<Stage>(recording, kind, kind != SpaceKind::none || !events.whole_life);
    std::size_t next = 0; // event
    walk(
        recording,
        [&](const Record &record) {
            const bool counts = events.has(next) && (next > 0 || events.whole_life);
            counts ? counted_changes(*stage, record) : stage->apply(record);
        },
        [&](const Record &record, std::size_t number) {
            std::uint32_t callbacks = 0;
            if (events.has(number))
                counted_collide(*stage, record, &callbacks, events.contacts ? find_contacts : count_pair);
            else
                stage->ask(record, &callbacks, count_pair);
            next = number + 1;
            return true;
        });
    if (events.whole_life)
        counted_end(stage);
}
} // namespace ode_predictive_space::recording
