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
#include "ode_predictive_space/recording/formatted.h"
#include "ode_predictive_space/recording/stage.h"

namespace ode_predictive_space::recording
{
// Callgrind counts in functions of these names. They are exported, so that it finds them in a program without symbols.
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

// Reads the records: calls `event` with its number for each event, until it returns false, and `change` for each other record.
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

std::string differing_pairs(const Recording &recording, SpaceKind kind, SpaceKind reference, std::size_t event)
{
    constexpr std::size_t most_bytes = 500, most_pairs = 3;
    const SharedArray<char> text(most_bytes);
    do_in_child([&] {
        Stage one(recording, kind), other(recording, reference);
        const auto describe = [&](const IdPairs &in_one, const IdPairs &in_other) {
            IdPairs differing;
            std::set_symmetric_difference(in_one.begin(), in_one.end(), in_other.begin(), in_other.end(),
                                          std::back_inserter(differing));
            std::string list;
            for (std::size_t i = 0; i < std::min(most_pairs, differing.size()); ++i)
            {
                const bool has_one = std::binary_search(in_one.begin(), in_one.end(), differing[i]);
                list += formatted("%s%u and %u only in %s", i ? ", " : ": geoms ", differing[i].first,
                                  differing[i].second, name_of(has_one ? kind : reference));
            }
            list += differing.size() > most_pairs ? ", \xe2\x80\xa6" : "";
            list.copy(&text[0], most_bytes - 1);
        };
        walk(
            recording,
            [&](const Record &record) {
                one.apply(record);
                other.apply(record);
            },
            [&](const Record &record, std::size_t number) {
                const IdPairs in_one = pairs_of(one, record), in_other = pairs_of(other, record);
                if (number == event)
                    describe(in_one, in_other);
                return number != event;
            });
    });
    return &text[0];
}

namespace
{
struct Measured
{
    std::uint64_t events;
    double processor_time;
};

void measure_here(const Recording &recording, SpaceKind kind, std::size_t most_events, double most_seconds,
                  const SharedArray<MeasuredEvent> &events, Measured &result)
{
    Stage stage(recording, kind);
    const double begin = now();
    double changes_begin = begin;
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
            // Before the first event, all geoms are made.
            const double notices = number > 0 ? start - changes_begin : 0;
            result.events = number + 1;
            events[number] = {static_cast<float>(end - start), static_cast<float>(notices), callbacks};
            changes_begin = now();
            return true;
        });
    result.processor_time = result.events > 0 ? processor_time() - processor_begin : 0;
}
} // namespace

Cost measure(const Recording &recording, SpaceKind kind, std::size_t most_events, double most_seconds)
{
    const SharedArray<MeasuredEvent> events(recording.events().size());
    const SharedArray<Measured> result(1);
    Cost cost;
    cost.failure = do_in_child([&] { measure_here(recording, kind, most_events, most_seconds, events, result[0]); });
    cost.processor_time = result[0].processor_time;
    for (std::size_t i = 0; i < result[0].events; ++i)
        cost.events.push_back(events[i]);
    return cost;
}

void take_least(const Cost &again, Cost &cost)
{
    for (std::size_t i = 0; i < std::min(again.events.size(), cost.events.size()); ++i)
    {
        cost.events[i].collide = std::min(cost.events[i].collide, again.events[i].collide);
        cost.events[i].notices = std::min(cost.events[i].notices, again.events[i].notices);
    }
}

namespace
{
// @param pairs those of spaces by box, sorted. @param by_shape those of spaces by shape, sorted.
void judge_pairs(const Stage &stage, const IdPairs &pairs, const IdPairs &by_shape, Callbacks &result)
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
            result.seconds_spared += end - start;
    }
}
} // namespace

std::string judge_callbacks(const Recording &recording, std::size_t most_events, double most_seconds,
                            Callbacks &callbacks)
{
    const SharedArray<Callbacks> result(1);
    const std::string failure = do_in_child([&] {
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
    callbacks = result[0];
    return failure;
}

// The first replay in a process also allocates what is kept for later ones.
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
    // For SpaceKind::none, a whole life is counted with geoms outside of all spaces.
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
