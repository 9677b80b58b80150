// A verifier of the objects of a store, and a scene of one object for it to look at.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_VERIFICATION_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_VERIFICATION_H

#include <algorithm>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/verify/verifier.h"
#include "tests/broadphase/support/proxies.h"

namespace ode_predictive_space
{
/// One object, wherever the test says.
struct OneObject : Scene
{
    Vector3 centre = Vector3::Zero();
    double radius = 1;
    int looks = 0;

    Box box() const { return Box(centre.array() - radius, centre.array() + radius); }

    void locate(const ProxyId *, std::size_t count, Location *locations) override
    {
        ++looks;
        std::fill_n(locations, count, Location{{centre.x(), centre.y(), centre.z()}, radius * radius});
    }
    void measure(const ProxyId *ids, std::size_t count, MeasuredBox *boxes) override
    {
        ++looks;
        for (std::size_t i = 0; i < count; ++i)
            boxes[ids[i]] = MeasuredBox(box());
    }
    Box bounds(ProxyId) override
    {
        ++looks;
        return box();
    }

    // Verification asks nothing else.
    void observe(const ProxyId *, std::size_t, const bool *, Observation *) override { ADD_FAILURE(); }
    std::optional<Vector3> pivot(ProxyId) override { return std::nullopt; }
    bool overlap(ProxyId, ProxyId) override { return false; }
    void find_disabled(const ProxyId *, std::size_t, std::vector<ProxyId> &) override { ADD_FAILURE(); }
};

/// A verifier of the objects of a store.
class Verification
{
public:
    explicit Verification(const ProxyStore &store)
    {
        verifier.resize(store.size());
        boxes_.resize(store.size());
        batch_.resize(store.size());
        none_.resize(store.size());
    }

    // Is the only object found within its envelope at this tick, at which it has moved?
    bool holds(Scene &scene, const ProxyStore &store, Tick now)
    {
        verifier.mark_moved(0);
        return !find_broken(scene, store, now);
    }

    // Does the report of its move leave it without a closer look at the tick that was expected?
    template <typename Object> bool report_settles(ProxyStore &store, const Object &object, Tick expected)
    {
        verifier.report_move(store, 0, object, expected);
        OneObject scene;
        scene.centre = object.centre;
        scene.radius = object.radius;
        find_broken(scene, store, expected);
        return scene.looks == 0;
    }

    Verifier verifier;

private:
    bool find_broken(Scene &scene, const ProxyStore &store, Tick now)
    {
        boxes_.invalidate(verifier.collect_moves());
        batch_.clear();
        const Verifier::Outcome outcome = verifier.find_broken(
            scene, store, boxes_, {now, verifier.collect_moves().size(), true, true, none_, none_}, batch_);
        verifier.clear_moves();
        EXPECT_EQ(outcome.verified, 1u);
        EXPECT_EQ(outcome.broken, batch_.size() - (store.predicted(0) ? 0 : 1));
        return batch_.contains(0);
    }

    MeasuredBoxes boxes_;
    Batch batch_;
    IdSet none_;
};

inline bool holds(Scene &scene, const ProxyStore &store, Tick now)
{
    return Verification(store).holds(scene, store, now);
}

inline const Path straight = {{1, 2, 3}, {0.5, 0, 0}, {0, 0.25, 0}};
inline const Deviation some = {0.25, 0.125, 0};
} // namespace ode_predictive_space

#endif
