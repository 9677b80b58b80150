#include "tests/benchmarks/contenders/world_run.h"

#include "tests/benchmarks/contenders/pair_hash.h"
#include "tests/benchmarks/contenders/statistics.h"

#include <array>

namespace ode_predictive_space::benchmarks
{
using namespace worlds;

namespace
{
constexpr double microseconds = 1e6;
} // namespace

double clock_overhead()
{
    std::vector<double> intervals(2001);
    for (double &interval : intervals)
    {
        const Clock::time_point begin = Clock::now();
        interval = seconds_between(begin, Clock::now());
    }
    std::sort(intervals.begin(), intervals.end());
    return percentile(intervals, 500);
}

WorldRun::WorldRun(std::unique_ptr<Contender> contender, const WorldFactory &factory)
    : contender_(std::move(contender)), world_(factory.make(contender_->space()))
{}

// The space is destroyed first and leaves its geoms to the world: some spaces search or sort all their geoms whenever one
// leaves, which would happen ten thousand times.
WorldRun::~WorldRun()
{
    dSpaceSetCleanup(contender_->space(), 0);
    contender_.reset();
}

// The order within a pair is the same in every space: colliders may depend on it.
void WorldRun::find_contacts()
{
    std::array<dContactGeom, max_contacts> contacts;
    touching_pairs_.clear();
    const Clock::time_point start = Clock::now();
    for (const auto &[first, second] : list_.geoms())
    {
        const bool swapped = geom_index(second) < geom_index(first);
        const dGeomID one = swapped ? second : first, other = swapped ? first : second;
        if (dCollide(one, other, max_contacts, contacts.data(), sizeof(dContactGeom)) > 0)
            touching_pairs_.emplace_back(geom_index(one), geom_index(other));
    }
    const double seconds = seconds_between(start, Clock::now());
    measured_.contact_times.push_back(microseconds * std::max(0.0, seconds - clock_overhead_));
    measured_.calls += list_.size();
}

// Some colliders find contacts although the boxes are apart: a space need not report such a pair.
void WorldRun::note_touching(const std::vector<IndexPair> &pairs)
{
    const auto is_false = [&](const IndexPair &pair) { return !std::binary_search(pairs.begin(), pairs.end(), pair); };
    touching_pairs_.erase(std::remove_if(touching_pairs_.begin(), touching_pairs_.end(), is_false),
                          touching_pairs_.end());
    measured_.touching += touching_pairs_.size();
    reported_.touching_hashes.push_back(hash_pairs(touching_pairs_));
}

void WorldRun::turn(int ticks)
{
    for (int tick = 0; tick < ticks; ++tick)
        make_tick();
}

void WorldRun::make_tick()
{
    list_.clear();
    const Clock::time_point start = Clock::now();
    world_->advance();
    const Clock::time_point moved = Clock::now();
    world_->collide(contender_->space(), &list_, PairList::near);
    const Clock::time_point collided = Clock::now();
    if (measuring_contacts_)
        find_contacts();
    contender_->finish(list_);
    const std::vector<IndexPair> pairs = list_.sorted();
    if (measuring_contacts_)
        note_touching(pairs);
    const Clock::time_point read = Clock::now();
    world_->respond(pairs);
    const Clock::time_point responded = Clock::now();

    measured_.collide_times.push_back(microseconds * std::max(0.0, seconds_between(moved, collided) - clock_overhead_));
    measured_.tick_times.push_back(microseconds *
                                   (seconds_between(start, collided) + seconds_between(read, responded)));
    reported_.pairs += pairs.size();
    reported_.tick_hashes.push_back(hash_pairs(pairs));
}
} // namespace ode_predictive_space::benchmarks
