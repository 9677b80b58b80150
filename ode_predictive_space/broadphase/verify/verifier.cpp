#include "ode_predictive_space/broadphase/verify/verifier.h"

#include <algorithm>

namespace ode_predictive_space
{
namespace
{
bool within(const Location &location, const ProxyStore &proxies, ProxyId id, Tick now)
{
    const double radius = proxies.stamps[id].radius;
    return location.squared_radius <= radius * radius && centre_inside(proxies.paths[id], location.centre, now);
}

// An object that is still within its envelope although no move of it was reported may have missed one tick only. A prediction
// costs as much as some tens of looks, so one look in as many decides that it has stopped.
bool has_stopped(const IdSet &moved, ProxyId id, Tick now)
{
    return !moved.contains(id) && (now + id) % tuning::looks_per_prediction == 0;
}
} // namespace

bool prediction_holds(Scene &scene, const ProxyStore &proxies, const MeasuredBoxes &boxes, const Location &location,
                      ProxyId id, Tick now)
{
    const ProxyRecord &record = proxies.records[id];
#ifdef ODE_PREDICTIVE_SPACE_WITHOUT_VERIFY
    // Only for the test which shows that the differential test notices when predictions are trusted blindly.
    return record.kind.check != Check::none;
#endif
    switch (record.kind.check)
    {
    case Check::centre:
        return within(location, proxies, id, now);
    case Check::bounds:
        // An object that no tree can hold is predicted anew whenever it moves: it may have become finite again.
        return !record.placement.unbounded && (surely_inside(proxies.paths[id], record, boxes[id], now) ||
                                               bounds_inside(proxies.paths[id], record, scene.bounds(id), now));
    case Check::none:
        break;
    }
    return false;
}

void Verifier::resize(std::size_t count)
{
    board_.resize(count);
    moved_.resize(count);
    doubtful_.resize(count);
    for (IdList *list : {&suspects_, &by_bounds_, &by_centre_})
        list->resize(count);
}

void Verifier::forget(ProxyId id)
{
    board_.erase(id);
    moved_.erase(id);
    doubtful_.erase(id);
}

// Those that were already off the predicted path when their move was reported, and those that were predicted to move and did
// not: no report tells that they have left their paths. When it is not the tick by which reports were judged, all that moved.
std::size_t Verifier::collect_suspects(const Circumstances &now)
{
    std::size_t verified = now.moves;
    suspects_.clear();
    for (std::size_t i = 0; i < moved_.words(); ++i)
    {
        const std::uint64_t included = ~now.excluded.word(i), moved = moved_.word(i) & included;
        const std::uint64_t stopped = now.time_passed ? now.moving.word(i) & ~moved_.word(i) & included : 0;
        verified += IdSet::count(stopped) - IdSet::count(moved_.word(i) & ~included);
        IdSet::visit_word(i, (now.as_expected ? doubtful_.word(i) & included : moved) | stopped,
                          [this](ProxyId id) { suspects_.add(id); });
    }
    return verified;
}

void Verifier::look_at_suspects(Scene &scene, const ProxyStore &proxies, MeasuredBoxes &boxes)
{
    by_bounds_.clear();
    by_centre_.clear();
    for (ProxyId id : suspects_)
    {
        const Check check = proxies.records[id].kind.check;
        if (check == Check::centre)
            by_centre_.add(id);
        else if (check == Check::bounds && !boxes.valid(id))
            by_bounds_.add(id);
    }
    boxes.measure(scene, by_bounds_);
    clear_scratch(locations_);
    if (by_centre_.empty())
        return;
    locations_.resize(by_centre_.size());
    scene.locate(by_centre_.data(), by_centre_.size(), locations_.data());
}

Verifier::Outcome Verifier::find_broken(Scene &scene, const ProxyStore &proxies, MeasuredBoxes &boxes,
                                        const Circumstances &now, Batch &batch)
{
    Outcome outcome;
    outcome.verified = collect_suspects(now);
    look_at_suspects(scene, proxies, boxes);
    const Location *location = locations_.data();
    const Location nowhere{};
    for (ProxyId id : suspects_)
    {
        const Check check = proxies.records[id].kind.check;
        const bool holds =
            prediction_holds(scene, proxies, boxes, check == Check::centre ? *location++ : nowhere, id, now.now);
        outcome.broken += !holds && check != Check::none;
        if (!holds || has_stopped(moved_, id, now.now))
            batch.add(id);
    }
    return outcome;
}

std::size_t Verifier::bytes() const
{
    return board_.bytes() + moved_.bytes() + doubtful_.bytes() + suspects_.bytes() + by_bounds_.bytes() +
           by_centre_.bytes() + bytes_of(locations_);
}
} // namespace ode_predictive_space
