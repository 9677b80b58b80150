#include "ode_predictive_space/preload/ledger.h"

#include <cerrno>
#include <cstdlib>
#include <string_view>

#include <unistd.h>

namespace ode_predictive_space::preload
{
Ledger::Ledger() : file_(CountsFile::open(secure_getenv(counts_variable)))
{
    if (file_)
        process_ = file_->new_process();
}

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
    if (number > last_space_with_page && !counts_.empty() && counts_.back()->number >= last_space_with_page)
        return counts_.back();
    SpaceCounts *counts = new_page();
    counts->process = process_;
    counts->process_id = getpid();
    std::string_view(program_invocation_short_name).copy(counts->program, sizeof counts->program - 1);
    counts->number = number;
    counts->space_class = dSpaceGetClass(space);
    counts->predictive = dSpaceIsPredictive(space);
    if (counts->predictive)
        counts->proximity = dPredictiveSpaceGetProximity(space);
    counts->state = PageState::counting;
    counts_.push_back(counts);
    return counts;
}

SpaceCounts *Ledger::new_page()
{
    SpaceCounts *page = file_ ? file_->take_page() : nullptr;
    return page ? page : &own_pages_.emplace_back();
}

void Ledger::begin_in_child()
{
    if (file_)
        process_ = file_->new_process();
    counts_.clear();
    for (auto &each : current_)
    {
        each.second.counts = nullptr;
        each.second.before_fork = each.second.latest;
    }
    mutex_.unlock();
}

void Ledger::note_lost_output()
{
    if (file_)
        file_->note_lost_output();
}

std::vector<SpaceCounts *> Ledger::all()
{
    const std::lock_guard<std::mutex> guard(mutex_);
    return counts_;
}

dPredictiveSpaceStats since(const dPredictiveSpaceStats &before, dPredictiveSpaceStats now)
{
    for (unsigned long dPredictiveSpaceStats::*counter :
         {&dPredictiveSpaceStats::ticks, &dPredictiveSpaceStats::moved, &dPredictiveSpaceStats::verified,
          &dPredictiveSpaceStats::violations, &dPredictiveSpaceStats::repredictions, &dPredictiveSpaceStats::woken,
          &dPredictiveSpaceStats::reported, &dPredictiveSpaceStats::scans})
        now.*counter -= before.*counter;
    return now;
}
} // namespace ode_predictive_space::preload
