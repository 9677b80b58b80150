// A scene that throws: the next update completes the interrupted tick.

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
struct Fault : std::runtime_error
{
    Fault() : std::runtime_error("fault") {}
};

// A scene that forwards to another until one call throws.
class FaultyScene : public Scene
{
public:
    /// @param calls number of calls that succeed.
    FaultyScene(Scene &scene, int calls) : scene_(scene), calls_left_(calls) {}

    void measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin) override
    {
        // Half of the objects are measured before the fault.
        scene_.measure(ids, count / 2, places, origin);
        call();
        scene_.measure(ids, count, places, origin);
    }
    void observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &origin) override
    {
        call();
        scene_.observe(ids, count, seen, origin);
    }
    Box bounds(ProxyId id) override
    {
        call();
        return scene_.bounds(id);
    }
    SampledPose pose(ProxyId id) override
    {
        call();
        return scene_.pose(id);
    }
    bool overlap(ProxyId first, ProxyId second) override
    {
        call();
        return scene_.overlap(first, second);
    }
    void find_disabled(const ProxyId *ids, std::size_t count, std::vector<ProxyId> &disabled) override
    {
        scene_.find_disabled(ids, count / 2, disabled);
        call();
        scene_.find_disabled(ids + count / 2, count - count / 2, disabled);
    }

private:
    void call()
    {
        if (calls_left_-- == 0)
            throw Fault();
    }

    Scene &scene_;
    int calls_left_;
};

enum class Moment
{
    first,      // nothing is known of any object
    few_leave,  // few objects leave their envelopes
    most_leave, // so many leave that all are swept
};

class Exceptions : public testing::TestWithParam<Moment>
{
protected:
    static constexpr std::size_t count = 300;
    static constexpr ProxyId removed[] = {7, 200}; // after an interrupted update

    Exceptions() : random_(static_cast<std::uint64_t>(GetParam()) + 1)
    {
        for (std::size_t i = 0; i < count; ++i)
            world_.add(random_object());
        for (ProxyId id : removed)
            world_.broadphase.set_role(id, Role::fixed_interactive);
        for (int ticks = 0; GetParam() != Moment::first && ticks < 100; ++ticks)
        {
            world_.advance();
            world_.tick();
            for (ProxyId id : removed)
                world_.broadphase.forecast(world_, id, 0); // starts the sampling of its motion
        }
        change();
    }

    bool sweeps() const
    {
        World world = world_;
        world.tick();
        return world.broadphase.counters().sweeps > world_.broadphase.counters().sweeps;
    }

    // Runs an update that is interrupted after this many calls, then complete ones.
    //
    // @return false if the update was completed by these calls.
    bool survives(int calls, bool is_tick, bool with_changes)
    {
        World world = world_;
        if (!breaks_off(world, calls, is_tick))
            return false;
        if (with_changes)
        {
            for (ProxyId id : removed)
                world.remove(id);
            world.add(ball({0, 0, 0}, 0.3, {0, 0, 0}));
        }
        if (calls % 2 == 0)
            world.broadphase.find_new_pairs(world);
        else
            world.broadphase.tick(world);
        expect_exact(world);
        for (int ticks = 0; ticks < 3; ++ticks)
        {
            world.advance();
            world.broadphase.tick(world);
            expect_exact(world);
        }
        return true;
    }

    void expect_all_survived(bool is_tick, bool with_changes)
    {
        // If there are many calls, only every seventh of them throws.
        constexpr int few = 40;
        int calls = 0;
        while (survives(calls, is_tick, with_changes) && !HasFailure())
            calls += calls < few ? 1 : 7;
        EXPECT_GT(calls, 2) << "the update asks for little";
    }

    // The scene is asked about each overlapping pair, and all pairs of the near set become stale.
    void test_by_sphere() { world_.broadphase.set_proximity_test(ProximityTest::sphere); }

private:
    Object random_object()
    {
        const Vector3 centre = random_.vector(1),
                      displacement = random_.chance(0.7) ? random_.vector(0.002) : Vector3::Zero();
        const bool with_body = random_.chance(0.5);
        Object object = random_.chance(0.5)   ? ball(centre, 0.1, displacement)
                        : random_.chance(0.5) ? box(centre, {0.1, 0.05, 0.08}, displacement, with_body)
                                              : block(centre, {0.1, 0.05, 0.08}, displacement, with_body);
        object.enabled = random_.chance(0.8);
        return object;
    }

    void change()
    {
        world_.advance();
        for (ProxyId id = 0; GetParam() == Moment::most_leave && id < count; id += 2)
            world_.place(id, random_.vector(1));
        for (ProxyId id = 0; id < count; id += 20)
        {
            world_.object(id).enabled = !world_.object(id).enabled;
            world_.place(id + 1, random_.vector(1));
            world_.object(id + 2).half *= 1.5;
            world_.object(id + 2).radius *= 1.5;
            world_.touch(id + 2);
        }
        for (ProxyId id = 3; id < count; id += 30)
            world_.remove(id);
        for (int i = 0; i < 15; ++i)
            world_.add(random_object());
        // Single precision cannot decide whether these touch.
        world_.place(4, {5, 0, 0});
        world_.place(5, {5 + world_.object(4).half.x() + world_.object(5).half.x(), 0, 0});
    }

    bool breaks_off(World &world, int calls, bool is_tick)
    {
        FaultyScene faulty(world, calls);
        std::vector<CandidatePair> room;
        try
        {
            if (is_tick)
                world.broadphase.tick(faulty);
            else
                world.broadphase.find_new_pairs(faulty);
            world.broadphase.report(faulty, room);
        }
        catch (const Fault &)
        {
            return true;
        }
        return false;
    }

    void expect_exact(World &world)
    {
        EXPECT_EQ(world.violated_invariant(), "");
        EXPECT_EQ(sorted_pairs(world.report()), world.overlapping());
    }

    Random random_;
    World world_;
};

std::string name_of_moment(const testing::TestParamInfo<Moment> &info)
{
    const char *const names[] = {"first", "few_leave", "most_leave"};
    return names[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(InTicks, Exceptions, testing::Values(Moment::first, Moment::few_leave, Moment::most_leave),
                         name_of_moment);

TEST_P(Exceptions, InATickLoseNoPair)
{
    EXPECT_EQ(sweeps(), GetParam() != Moment::few_leave);
    expect_all_survived(true, false);
}

TEST_P(Exceptions, InAQuestionLoseNoPair)
{
    expect_all_survived(false, false);
}

TEST_P(Exceptions, InAReportLoseNoPair)
{
    test_by_sphere();
    expect_all_survived(true, false);
}

TEST_P(Exceptions, LetObjectsComeAndGoBeforeTheNextTick)
{
    expect_all_survived(true, true);
}
} // namespace
} // namespace ode_predictive_space
