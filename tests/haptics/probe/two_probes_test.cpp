// Two probes in one scene: each touches the tool of the other, and both hands get the same force.

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/probe.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "ode_predictive_space/haptics/virtual_device.h"

#include "tests/haptics/support/probe_fixture.h"

#include <atomic>
#include <mutex>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
struct TwoProbeWorld
{
    ProbeWorld world;
    HapticProbe *probes[2] = {};

    void collide() { dSpaceCollide(world.space, this, &near); }

    void tick(double time)
    {
        for (HapticProbe *probe : probes)
            probe->begin(time);
        collide();
        for (HapticProbe *probe : probes)
            probe->render(dt);
    }

    static void near(void *data, dGeomID first, dGeomID second)
    {
        for (HapticProbe *probe : static_cast<TwoProbeWorld *>(data)->probes)
            if (probe->touch(first, second))
                return;
        ADD_FAILURE() << "no probe took the pair";
    }
};

/// A hand that comes from one side (-1 or 1) within a second and presses its springs of 300 N/m by 1 cm: 3 N.
VirtualDevice hand_from(double side, double stroke = 0.01)
{
    return VirtualDevice({}, [side, stroke](double seconds) -> Vector3 {
        const double u = std::clamp(seconds - 1, 0.0, 1.0);
        return {side * (0.05 - u * u * (3 - 2 * u) * (0.05 - radius + stroke)), 0, 0};
    });
}

/// The forces on both hands from the third second on.
struct Balance
{
    double most_difference = 0; ///< N; between one force and the opposite of the other
    double least = infinity;    ///< N
    double most = 0;            ///< N

    void add(const RenderedTick &one, const RenderedTick &other)
    {
        if (one.time < 3)
            return;
        most_difference = std::max(most_difference, (one.force + other.force).norm());
        least = std::min({least, one.force.norm(), other.force.norm()});
        most = std::max({most, one.force.norm(), other.force.norm()});
    }

    void expect_even(const std::string &what) const
    {
        EXPECT_LE(most_difference, 0.05) << what;
        EXPECT_GT(least, 1) << what;
        EXPECT_LT(most - least, 0.1) << what;
    }
};

using TwoProbes = HapticProbeTest;

TEST_F(TwoProbes, PressedOnEachOtherFeelTheSameForceInEitherOrder)
{
    for (const int order : {0, 1, 2, 3, 4})
    {
        TwoProbeWorld scene;
        VirtualDevice left = hand_from(-1);
        VirtualDevice right = hand_from(1);
        const RenderSettings soft = with_law(std::make_shared<ProxyLaw>(Material{300}));
        HapticProbe first(left, scene.world.space, radius, order < 2 ? RenderSettings() : soft);
        HapticProbe second(right, scene.world.space, radius);
        scene.probes[order % 2] = &first;
        scene.probes[1 - order % 2] = &second;
        if (order == 4) // bits of one side suffice
            dGeomSetCollideBits(first.geom(), 0);
        Balance balance;
        for (int tick = 0; tick < 8000; ++tick)
        {
            scene.tick(dt * tick);
            balance.add(first.last_tick(), second.last_tick());
        }
        balance.expect_even("order " + std::to_string(order));
        EXPECT_LT(first.last_tick().force.x(), 0);
    }
}

/// A loop of one thread or two runs the first probe; the program runs the second in the loop's callbacks.
TEST_F(TwoProbes, InALoopOfOneThreadAndOfTwo)
{
    for (const bool decoupled : {false, true})
    {
        TwoProbeWorld scene;
        VirtualDevice left = hand_from(-1);
        VirtualDevice right = hand_from(1);
        HapticProbe first(left, scene.world.space, radius);
        HapticProbe second(right, scene.world.space, radius);
        scene.probes[0] = &first;
        scene.probes[1] = &second;
        SimulatedClock clock;
        Balance balance;
        HapticLoop loop(first, simulated(clock, 8, decoupled));
        SceneWork work;
        work.collide = [&] {
            second.begin(clock.now());
            scene.collide();
            second.render(dt);
        };
        work.advance = [&](double) { balance.add(loop.latest(), second.last_tick()); };
        loop.run(work);
        balance.expect_even(decoupled ? "two threads" : "one thread");
    }
}

using TwoLoops = HapticProbeTest;

TEST_F(TwoLoops, InTwoThreadsByTheWallClockFeelEachOther)
{
    for (const bool decoupled : {false, true})
    {
        const auto from = [](double side) {
            return [side](double seconds) -> Vector3 {
                return {side * (0.02 - 0.012 * std::min(1.0, 2 * seconds)), 0, 0};
            };
        };
        TwoProbeWorld scene;
        ScriptedDevice left(from(-1)), right(from(1));
        HapticProbe first(left, scene.world.space, radius);
        HapticProbe second(right, scene.world.space, radius);
        scene.probes[0] = &first;
        scene.probes[1] = &second;
        std::mutex mutex;
        std::atomic<double> requested[2] = {0, 0}; // N
        std::atomic<bool> both_pressed{false};
        const auto run = [&](int which) {
            LoopSettings settings;
            settings.decoupled = decoupled;
            settings.duration = 60; // simulated; both touch each other long before
            settings.scene = &mutex;
            settings.ask_for_priority = false;
            HapticLoop loop(*scene.probes[which], settings);
            const auto advance = [&](double) {
                requested[which] = loop.latest().requested.x();
                both_pressed = both_pressed || (requested[0] < -0.1 && requested[1] > 0.1);
                if (both_pressed)
                    loop.stop();
            };
            loop.run({[&] { scene.collide(); }, advance});
        };
        std::thread other([&] {
            dAllocateODEDataForThread(dAllocateMaskAll);
            run(1);
            dCleanupODEAllDataForThread();
        });
        run(0);
        other.join();
        EXPECT_TRUE(both_pressed) << requested[0] << " and " << requested[1];
    }
}

/// The search region of the first probe grows far beyond its tool, which is pressed into a wall.
TEST_F(TwoProbes, OneThatIsFarFromTheToolOfTheOtherFeelsNothingOfIt)
{
    TwoProbeWorld scene;
    scene.world.add_box({0.1, 0.1, 0.1}, {0, 0, -0.05});
    ScriptedDevice pressing(reach({0, 0, 0.03}, {0, 0, -0.02}));
    ScriptedDevice beside([](double) -> Vector3 { return {0.022, 0, 0.011}; });
    HapticProbe first(pressing, scene.world.space, radius);
    HapticProbe second(beside, scene.world.space, radius);
    scene.probes[0] = &first;
    scene.probes[1] = &second;
    for (int tick = 0; tick < 3000; ++tick)
    {
        scene.tick(dt * tick);
        ASSERT_TRUE(second.last_tick().force.isZero(0)) << tick;
        ASSERT_NEAR(first.last_tick().force.x(), 0, 1e-9) << tick;
    }
    EXPECT_GT(first.last_tick().force.z(), 5);
}

TEST_F(TwoProbes, FeelNothingOfEachOtherWhereTheirBitsOrSpacesSayNo)
{
    for (const bool by_bits : {true, false})
    {
        TwoProbeWorld scene;
        ProbeWorld elsewhere;
        VirtualDevice left = hand_from(-1);
        VirtualDevice right = hand_from(1);
        HapticProbe first(left, scene.world.space, radius);
        HapticProbe second(right, by_bits ? scene.world.space : elsewhere.space, radius);
        if (by_bits)
        {
            for (HapticProbe *probe : {&first, &second})
            {
                dGeomSetCategoryBits(probe->geom(), 1);
                dGeomSetCollideBits(probe->geom(), ~1UL);
            }
        }
        scene.probes[0] = &first;
        scene.probes[1] = &second;
        for (int tick = 0; tick < 3000; ++tick)
        {
            scene.tick(dt * tick);
            ASSERT_TRUE(first.last_tick().force.isZero(0) && second.last_tick().force.isZero(0)) << tick;
        }
    }
}

TEST_F(TwoProbes, OneThatIsDestroyedIsFeltNoMore)
{
    TwoProbeWorld scene;
    VirtualDevice left = hand_from(-1);
    VirtualDevice right = hand_from(1);
    HapticProbe first(left, scene.world.space, radius);
    auto second = std::make_unique<HapticProbe>(right, scene.world.space, radius);
    scene.probes[0] = &first;
    scene.probes[1] = second.get();
    int tick = 0;
    for (; tick < 3000; ++tick)
        scene.tick(dt * tick);
    ASSERT_GT(first.last_tick().force.norm(), 1);
    second.reset();
    scene.probes[1] = &first;
    for (; tick < 3200; ++tick)
    {
        first.begin(dt * tick);
        scene.collide();
        first.render(dt);
    }
    EXPECT_TRUE(first.last_tick().force.isZero(0));
}
} // namespace
} // namespace ode_predictive_space::haptics
