#include "ode_predictive_space/broadphase/sweep/sweeping.h"

#include <algorithm>
#include <utility>

namespace ode_predictive_space
{
void Sweeping::start(const IdSet &members, bool with_new_objects)
{
    mode_ = Mode::sweeping;
    with_new_objects_ = with_new_objects;
    if (with_new_objects)
        policy_.begin_with_new_objects();
    waiting_.clear();
    waiting_count_ = 0;
    parts_joined_ = false;
    pairs_.clear();
    sampler_.choose(members);
}

void Sweeping::start_filling(const IdSet &members, std::size_t count)
{
    mode_ = Mode::filling;
    waiting_ = members;
    waiting_count_ = count;
}

void Sweeping::wait(ProxyId id)
{
    mode_ = Mode::filling;
    waiting_count_ += !waiting_.contains(id);
    waiting_.insert(id);
}

void Sweeping::stop_waiting(ProxyId id)
{
    if (!waits(id))
        return;
    waiting_.erase(id);
    --waiting_count_;
}

void Sweeping::finish_filling(bool in_parts)
{
    if (mode_ != Mode::filling || waiting_count_ > 0)
        return;
    mode_ = Mode::predicting;
    release();
    parts_joined_ = in_parts;
}

bool Sweeping::end_for_predictions()
{
    if (mode_ != Mode::sweeping || !with_new_objects_)
        return false;
    mode_ = Mode::predicting;
    release();
    return true;
}

bool Sweeping::take_parts_joined()
{
    return std::exchange(parts_joined_, false);
}

// Objects that were not there at the last sweep have a place in the next queue.
void Sweeping::add_part(std::size_t objects, const IdSet &idle, Batch &batch)
{
    if (queue_.empty())
    {
        sort_and_sweep_.sort_along_widest(items_, queue_);
        idle.for_each([this](ProxyId id) { queue_.push_back(id); });
    }
    batch.begin_neighbours();
    std::size_t room = std::max(tuning::least_part, objects / tuning::parts);
    for (; room > 0 && !queue_.empty(); queue_.pop_back())
        if (waits(queue_.back()))
        {
            batch.add(queue_.back());
            --room;
        }
}

void Sweeping::find_pairs(const IdSet &members, const IdSet &idle, const MeasuredBoxes &boxes)
{
    items_.clear();
    for (std::size_t i = 0; i < members.words(); ++i)
        IdSet::visit_word(i, members.word(i) & ~idle.word(i), [&](ProxyId id) {
            items_.push_back({id, boxes[id].outer()});
        });
    pairs_.clear();
    sort_and_sweep_.find_pairs(items_, pairs_);
}

CandidatePair *Sweeping::report(const OverlapTest &test, const IdSet &members, CandidatePair *room) const
{
    return for_each_pair(members, OverlapCollector(test, room)).end();
}

void Sweeping::release()
{
    sort_and_sweep_ = {};
    free_memory(items_);
    free_memory(pairs_);
    free_memory(queue_);
}

std::size_t Sweeping::bytes() const
{
    return sort_and_sweep_.bytes() + waiting_.bytes() + bytes_of(queue_) + bytes_of(items_) + bytes_of(pairs_);
}
} // namespace ode_predictive_space
