#include "demos/runs/world_run.h"

#include <algorithm>
#include <array>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr int ticks_per_turn = 100;
constexpr double microseconds = 1e6;

using TickHashes = std::vector<std::uint64_t>;

int first_difference(const std::vector<const TickHashes *> &runs)
{
    for (std::size_t tick = 0; !runs.empty() && tick < runs.front()->size(); ++tick)
    {
        for (const TickHashes *run : runs)
        {
            if (run->at(tick) != runs.front()->at(tick))
                return static_cast<int>(tick);
        }
    }
    return -1;
}
} // namespace

double clock_overhead()
{
    std::vector<double> intervals(2001);
    for (double &interval : intervals)
    {
        const Clock::time_point begin = Clock::now();
        interval = seconds_between(begin, Clock::now());
    }
    return summarise(intervals).median;
}

WorldRun::WorldRun(std::unique_ptr<Contender> contender, const WorldFactory &factory)
    : contender_(std::move(contender)), scene_(factory.make(contender_->space()))
{}

// The space is destroyed first and leaves its geoms to the scene: some spaces search or sort all their geoms whenever one
// leaves, which would happen ten thousand times.
WorldRun::~WorldRun()
{
    dSpaceSetCleanup(contender_->space(), 0);
    contender_.reset();
}

void WorldRun::collide()
{
    list_.clear();
    if (queries_ == 0)
        scene_->collide(contender_->space(), &list_, PairList::near);
    const auto space = reinterpret_cast<dGeomID>(contender_->space());
    for (std::size_t query = 0; query < queries_; ++query)
        dSpaceCollide2(scene_->queries()[query], space, &list_, &PairList::collect);
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
    const Clock::time_point start = Clock::now();
    scene_->advance();
    const Clock::time_point moved = Clock::now();
    collide();
    const Clock::time_point collided = Clock::now();
    if (measuring_contacts_)
        find_contacts();
    reported_.false_pairs += contender_->finish(list_);
    const std::vector<IndexPair> pairs = list_.sorted();
    if (measuring_contacts_)
        note_touching(pairs);
    const Clock::time_point read = Clock::now();
    scene_->respond(pairs);
    const Clock::time_point responded = Clock::now();

    measured_.collide_times.push_back(microseconds * std::max(0.0, seconds_between(moved, collided) - clock_overhead_));
    measured_.tick_times.push_back(microseconds *
                                   (seconds_between(start, collided) + seconds_between(read, responded)));
    reported_.pairs += pairs.size();
    reported_.contacts += scene_->contacts();
    reported_.tick_hashes.push_back(hash_pairs(pairs));
}

WorldRuns make_runs(const std::vector<SpaceKind> &kinds, const WorldFactory &factory)
{
    WorldRuns runs;
    for (const SpaceKind kind : kinds)
        runs.push_back(std::make_unique<WorldRun>(make_contender(kind, factory), factory));
    return runs;
}

void run_by_turns(const WorldRuns &runs, int ticks)
{
    std::size_t first = 0;
    for (int done = 0; done < ticks; done += ticks_per_turn, ++first)
    {
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[(first + i) % runs.size()]->turn(std::min(ticks_per_turn, ticks - done));
    }
}

int first_difference(const WorldRuns &runs)
{
    std::vector<const TickHashes *> exact;
    for (const auto &run : runs)
    {
        if (run->contender().exact())
            exact.push_back(&run->reported().tick_hashes);
    }
    return first_difference(exact);
}

int first_difference_of_contacts(const WorldRuns &runs)
{
    std::vector<const TickHashes *> all;
    for (const auto &run : runs)
        all.push_back(&run->reported().touching_hashes);
    return first_difference(all);
}
} // namespace ode_predictive_space::worlds
