// The stages of the tick that look at the objects themselves; included by broadphase.h alone.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_TICK_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_TICK_H

#include "ode_predictive_space/broadphase/broadphase.h"

namespace ode_predictive_space
{
// Of new objects only the velocities are known, and not even how far these carry them. So where most are new they are scanned
// for some ticks first; that is quicker than prediction, too, for the tick in which a program begins.
template <typename Scene> void Broadphase::update(Scene &scene, bool is_tick)
{
    const Tick expected = next_tick_;
    noticed_.take_down(moved_);
    const bool time_passes = this->time_passes(is_tick);
    if (moved_.empty() && due_anew_.empty())
        return;
    counters_.moved += moved_.size();
    if (time_passes)
        advance_clock();
    if (policy_.scanning() && calm_returns(scene, time_passes))
        stop_scanning();
    else if (!policy_.scanning() && mostly_new())
    {
        policy_.begin();
        start_scanning();
    }
    if (policy_.scanning())
    {
        scan(scene);
        return;
    }
    verify(scene, time_passes, now_ == expected);
    expire();
    const std::size_t predicted = objects() - waiting_count_;
    if (time_passes && predicted > 0 && policy_.prediction_fails(broken_, predicted))
    {
        start_scanning();
        scan(scene);
        return;
    }
    if (!batch_.empty() || !due_.empty() || scanning() || parts_joined_)
        renew(scene);
}

template <typename Scene> bool Broadphase::calm_returns(Scene &scene, bool time_passes)
{
    return time_passes && policy_.calm_returns(scouts_.calm(scene, members_, predictor.step_estimate));
}

// New predictions for the batch, or for as much of it as a tick can bear. As long as others wait, a sweep finds the pairs.
template <typename Scene> void Broadphase::renew(Scene &scene)
{
    const bool in_parts = scanning();
    const bool too_many = broken_ > most_at_once();
    if (too_many)
        postpone_batch();
    const std::size_t single = batch_.size();
    if (in_parts && !too_many)
        add_part();
    predict(scene);
    find_pairs(single);
    schedule();
    wake();
    if (scanning())
        sweep_all(scene);
    else if (in_parts)
        finish_parts();
    finish_update();
}

template <typename Scene> void Broadphase::verify(Scene &scene, bool time_passes, bool as_expected)
{
    collect_suspects(time_passes, as_expected);
    measured_ -= moved_;
    broken_ = 0;
    for (std::size_t i = 0; i < suspects_.size(); ++i)
    {
        if (overflows_cache())
            prefetch_bounds(scene, suspects_, i);
        const ProxyId id = suspects_[i];
        if (!holds(scene, id))
            broken_ += proxies_.bounds[id].check != Check::none;
        else if (!has_stopped(id))
            continue;
        add_to_batch(id);
    }
    counters_.violations += broken_;
    suspects_.clear();
    if (sampled_ > 0)
        interactive_.for_each([&](ProxyId id) {
            if (moved_.contains(id))
                remember(scene, id);
        });
    take_note_of_moves();
}

// Bounds that the report will look at, too, are measured for it, while they are in the cache. As measured they are nearly
// always well within the envelope.
template <typename Scene> bool Broadphase::holds(Scene &scene, ProxyId id)
{
    const PackedBounds &bounds = proxies_.bounds[id];
    if (bounds.check == Check::bounds && near_.members().contains(id))
    {
        if (!measured_.contains(id))
        {
            scene.measure(id, boxes_[id]);
            measured_.insert(id);
        }
        if (surely_inside(proxies_.paths[id], bounds, boxes_[id], now_))
            return true;
    }
    return prediction_holds(scene, proxies_, id, now_);
}

// What is read of each object is scattered over memory: it is fetched some objects ahead.
template <typename Scene>
void Broadphase::prefetch_bounds(const Scene &scene, const std::vector<ProxyId> &ids, std::size_t i) const
{
    constexpr std::size_t far = 16;
    scene.prefetch(later(ids, i, far));
    scene.prefetch_pose(later(ids, i));
}

template <typename Scene> void Broadphase::prefetch_motion(const Scene &scene, std::size_t i) const
{
    prefetch_bounds(scene, batch_, i);
    scene.prefetch_velocity(later(batch_, i));
    proxies_.prefetch(later(batch_, i));
}

// A batch is often so small that nothing of it lies some objects ahead.
template <typename Scene> void Broadphase::prefetch_first_motions(const Scene &scene) const
{
    constexpr std::size_t few = 16;
    const std::size_t count = overflows_cache() ? std::min(few, batch_.size()) : 0;
    for (std::size_t i = 0; i < count; ++i)
    {
        scene.prefetch(batch_[i]);
        proxies_.prefetch(batch_[i]);
    }
    for (std::size_t i = 0; i < count; ++i)
    {
        scene.prefetch_pose(batch_[i]);
        scene.prefetch_velocity(batch_[i]);
    }
}

// The same point of the object that is predicted.
template <typename Scene> void Broadphase::remember(Scene &scene, ProxyId id)
{
    const std::optional<Vector3> pivot = scene.pivot(id);
    predictor.remember(proxies_, id, pivot ? *pivot : Vector3(scene.bounds(id).center()), now_);
}

template <typename Scene> void Broadphase::predict(Scene &scene)
{
    prefetch_first_motions(scene);
    for (std::size_t i = 0; i < batch_.size(); ++i)
    {
        if (overflows_cache())
            prefetch_motion(scene, i);
        const ProxyId id = batch_[i];
        PackedBounds &bounds = proxies_.bounds[id];
        stop_waiting(id);
        near_.retire(id, now_);
        unpredicted_ -= bounds.check == Check::none;
        // Tight bounds are given up when they do not last, or were in force and no near pair needed them.
        bounds.crowded &= bounds.tight_bounds_last && (near_.members().contains(id) || bounds.check != Check::bounds);
        predictor.predict(proxies_, id, scene.observe(id, bounds.crowded), now_);
        if (bounds.still)
            moving_.erase(id);
        else
            moving_.insert(id);
        if (bounds.until != now_)
            wheel_.schedule(bounds.until, {id, no_proxy, proxies_.generations[id], 0});
        sample(id, bounds.role == Role::fixed_interactive || (bounds.role == Role::interactive && !bounds.still &&
                                                              (interactive_.contains(id) || sampled_ < most_sampled)));
    }
    counters_.repredictions += batch_.size();
}

template <typename Scene> void Broadphase::scan(Scene &scene)
{
    if (moved_.empty())
        return;
    measured_ -= moved_;
    take_note_of_moves();
    sweep_all(scene);
}

template <typename Scene> void Broadphase::sweep_all(Scene &scene)
{
    ++counters_.scans;
    measure_all(scene, members_);
    items_.resize(objects());
    std::size_t count = 0;
    members_.for_each([&](ProxyId id) { items_[count++] = {id, boxes_[id].outer()}; });
    scanned_.clear();
    sweep_.find_pairs(items_, scanned_);
}

// Looks at the bounds of those that have moved since they were last looked at, and are still there.
template <typename Scene> void Broadphase::measure_all(Scene &scene, const IdSet &wanted)
{
    MeasuredBox *const boxes = boxes_.data();
    const auto each = [&](auto visit) {
        for (std::size_t i = 0; i < wanted.words(); ++i)
            IdSet::visit_word(i, wanted.word(i) & members_.word(i) & ~measured_.word(i), visit);
    };
    if (!overflows_cache())
        each([&](ProxyId id) { scene.measure(id, boxes[id]); });
    else
    {
        each([this](ProxyId id) { suspects_.push_back(id); });
        for (std::size_t i = 0; i < suspects_.size(); ++i)
        {
            prefetch_bounds(scene, suspects_, i);
            prefetch(&boxes[later(suspects_, i)]);
            scene.measure(suspects_[i], boxes[suspects_[i]]);
        }
        suspects_.clear();
    }
    measured_ |= wanted;
}

// Of what the last sweep found, all but the pairs of those that were removed since. (What is new since is swept before it is
// asked for.)
template <typename Visit> Visit Broadphase::for_scanned(Visit visit) const
{
    for (const CandidatePair &pair : scanned_)
        if (members_.contains(pair.first) && members_.contains(pair.second))
            visit(pair);
    return visit;
}

// Visits the pairs that are tested and not stale; returns the visitor.
template <typename Visit> Visit Broadphase::visit_tested(Visit visit)
{
    if (scanning())
        return for_scanned(visit);
    if (boxes_overflow_cache())
        return near_.visit_tested(now_, box_fetcher(), visit);
    return near_.visit_tested(
        now_, [](const CandidatePair &) {}, visit);
}

// Each pair is written and those that are apart are overwritten: which they are is hard to foretell, and easy to count.
template <typename Scene> struct Broadphase::OverlapTest
{
    Scene &scene;
    const MeasuredBox *boxes;
    CandidatePair *end;
    bool by_sphere;

    bool overlap(const CandidatePair &pair) const
    {
        const Comparison compared = compare(boxes[pair.first], boxes[pair.second]);
        if (compared.unsure() || (by_sphere && compared.overlap()))
            return scene.overlap(pair.first, pair.second);
        return compared.overlap();
    }

    void operator()(const CandidatePair &pair)
    {
        const bool overlaps = overlap(pair);
        *end = pair;
        end += overlaps;
    }
};

template <typename Scene> std::size_t Broadphase::report(Scene &scene, std::vector<CandidatePair> &room)
{
    if (scanning())
        return test_near(scene, room);
    measure_all(scene, near_.members());
    near_.wake_disturbed();
    std::size_t count = test_near(scene, room);
    for (const CandidatePair &pair : near_.together())
        room[count++] = pair;
    let_rest(scene);
    return count;
}

// Leaves room for those at rest.
template <typename Scene> std::size_t Broadphase::test_near(Scene &scene, std::vector<CandidatePair> &room)
{
    const std::size_t most = tested_pairs() + near_.together().size();
    if (room.size() < most)
        room.resize(most);
    const OverlapTest<Scene> test{scene, boxes_.data(), room.data(), measure_ == Proximity::sphere};
    return static_cast<std::size_t>(visit_tested(test).end - room.data());
}

// Once in some reports the pairs of those that have not moved since the last time are told from the others.
template <typename Scene> void Broadphase::let_rest(Scene &scene)
{
    constexpr unsigned reports_per_rest = 32;
    if (++reports_ % reports_per_rest != 0)
        return;
    const OverlapTest<Scene> test{scene, boxes_.data(), nullptr, measure_ == Proximity::sphere};
    near_.let_rest([&](const CandidatePair &pair) {
        if (stirred_.contains(pair.first) || stirred_.contains(pair.second))
            return NearSet::Verdict::open;
        return test.overlap(pair) ? NearSet::Verdict::together : NearSet::Verdict::apart;
    });
    stirred_.clear();
}

template <typename Probe, typename Visit> void Broadphase::walk(const Probe &probe, Visit visit) const
{
    if (!scanning())
    {
        index_.walk(probe, visit);
        return;
    }
    // Where those that wait are in the index, they are stale.
    index_.walk(probe, [&](ProxyId id) {
        if (!is_waiting(id))
            visit(id);
    });
    const IdSet &unpredicted = policy_.scanning() ? members_ : waiting_;
    unpredicted.for_each([&](ProxyId id) {
        if (probe.overlaps(boxes_[id].outer()))
            visit(id);
    });
}
} // namespace ode_predictive_space

#endif
