#include "ode_predictive_space/preload/ledger.h"

#include "ode_predictive_space/preload/notes_to_launcher.h"

namespace ode_predictive_space::preload
{
void Ledger::made(dSpaceID space, bool is_substitute)
{
    const std::lock_guard<std::mutex> guard(mutex_);
    enter(space, is_substitute);
}

bool Ledger::is_substitute(dSpaceID space) const
{
    const std::lock_guard<std::mutex> guard(mutex_);
    const auto found = current_.find(space);
    return found != current_.end() && found->second.is_substitute;
}

KnownSpace &Ledger::known(dSpaceID space)
{
    const auto found = current_.find(space);
    if (found == current_.end())
        return enter(space, false);
    if (!found->second.counts)
        found->second.counts = begin_counts(space, found->second.number);
    return found->second;
}

KnownSpace &Ledger::enter(dSpaceID space, bool is_substitute)
{
    ++made_;
    return current_[space] = {made_, is_substitute, begin_counts(space, made_), {}, {}};
}

SpaceCounts *Ledger::begin_counts(dSpaceID space, int number)
{
    if (number > last_space_with_line && !counts_.empty() && counts_.back().number >= last_space_with_line)
        return &counts_.back();
    if (counts_.empty())
        leave_note(Note::began);
    SpaceCounts &counts = counts_.emplace_back();
    counts.number = number;
    counts.space_class = dSpaceGetClass(space);
    counts.predictive = dSpaceIsPredictive(space);
    if (counts.predictive)
        counts.proximity = dPredictiveSpaceGetProximity(space);
    return &counts;
}

void Ledger::begin_in_child()
{
    counts_.clear();
    for (auto &each : current_)
    {
        each.second.counts = nullptr;
        each.second.before_fork = each.second.latest;
    }
    mutex_.unlock();
}

std::deque<SpaceCounts> Ledger::all() const
{
    const std::lock_guard<std::mutex> guard(mutex_);
    return counts_;
}

dPredictiveSpaceStats since(const dPredictiveSpaceStats &before, dPredictiveSpaceStats now)
{
    for (unsigned long dPredictiveSpaceStats::*counter :
         {&dPredictiveSpaceStats::ticks, &dPredictiveSpaceStats::moved, &dPredictiveSpaceStats::violations,
          &dPredictiveSpaceStats::repredictions, &dPredictiveSpaceStats::woken, &dPredictiveSpaceStats::reported,
          &dPredictiveSpaceStats::scans})
        now.*counter -= before.*counter;
    return now;
}
} // namespace ode_predictive_space::preload
