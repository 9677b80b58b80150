#include <thread>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

void fill(Scenario &scene, int seed)
{
    for (int i = 0; i < 60; ++i)
    {
        dGeomID geom = scene.sphere(0.4, i % 8, i / 8, 0.5 * ((i * 7 + seed) % 5));
        scene.body(geom, 0.3 * ((i + seed) % 5 - 2), 0.2 * (i % 3 - 1), i % 2 ? 0.5 : -0.5);
    }
}

// Steps a world in its own thread, as ODE's default is shared by all worlds of the process.
class OwnStepping
{
public:
    explicit OwnStepping(dWorldID world)
        : world_(world), implementation_(dThreadingAllocateSelfThreadedImplementation())
    {
        dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(implementation_),
                                             implementation_);
    }

    ~OwnStepping()
    {
        dWorldSetStepThreadingImplementation(world_, nullptr, nullptr);
        dThreadingFreeImplementation(implementation_);
    }

    OwnStepping(const OwnStepping &) = delete;
    OwnStepping &operator=(const OwnStepping &) = delete;

private:
    dWorldID world_;
    dThreadingImplementationID implementation_;
};

std::vector<Pairs> run_alone(SpaceKind kind, int seed)
{
    Scenario scene(kind);
    const OwnStepping stepping(scene.world());
    fill(scene, seed);
    for (int tick = 0; tick < 300; ++tick)
    {
        // dWorldQuickStep() uses random numbers that all threads share.
        dWorldStep(scene.world(), 0.01);
        scene.note(unordered(collide(scene.space())));
    }
    return scene.log();
}

TEST_F(Contract, 16_SpacesAreCollidedInDifferentThreads)
{
    std::vector<std::vector<Pairs>> results(4);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < results.size(); ++i)
    {
        threads.emplace_back([&results, i] {
            const OdeThread ode;
            results[i] = run_alone(SpaceKind::predictive, static_cast<int>(i));
        });
    }
    for (std::thread &thread : threads)
        thread.join();
    for (std::size_t i = 0; i < results.size(); ++i)
        EXPECT_EQ(results[i], run_alone(SpaceKind::simple, static_cast<int>(i))) << "thread " << i;
}

TEST_F(Contract, 16_ASpaceMadeInOneThreadIsCollidedInAnother)
{
    Scenario scene(SpaceKind::predictive);
    for (int i = 0; i < 10; ++i)
        scene.sphere(1, 0.1 * i, 0, 0);
    EXPECT_EQ(collide(scene.space()).size(), 45u);
    std::size_t there = 0;
    std::thread([&] {
        const OdeThread ode;
        dGeomSetPosition(dSpaceGetGeom(scene.space(), 0), 9, 9, 9);
        there = collide(scene.space()).size();
    }).join();
    EXPECT_EQ(there, 36u);
    EXPECT_EQ(collide(scene.space()).size(), 36u);
}

class Workers
{
public:
    explicit Workers(dWorldID world)
        : implementation_(dThreadingAllocateMultiThreadedImplementation()),
          pool_(dThreadingAllocateThreadPool(3, 0, dAllocateFlagBasicData, nullptr)), world_(world)
    {
        dThreadingThreadPoolServeMultiThreadedImplementation(pool_, implementation_);
        dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(implementation_),
                                             implementation_);
    }

    ~Workers()
    {
        dThreadingImplementationShutdownProcessing(implementation_);
        dThreadingFreeThreadPool(pool_);
        dWorldSetStepThreadingImplementation(world_, nullptr, nullptr);
        dThreadingFreeImplementation(implementation_);
    }

    Workers(const Workers &) = delete;
    Workers &operator=(const Workers &) = delete;

private:
    dThreadingImplementationID implementation_;
    dThreadingThreadPoolID pool_;
    dWorldID world_;
};

std::vector<Pairs> run_with_workers(SpaceKind kind)
{
    Scenario scene(kind);
    fill(scene, 0);
    const Workers workers(scene.world());
    for (int tick = 0; tick < 200; ++tick)
    {
        scene.step(0.01);
        scene.note(kind == SpaceKind::simple ? unordered(collide(scene.space())) : collide(scene.space()));
        if (kind == SpaceKind::predictive)
        {
            EXPECT_EQ(dPredictiveSpaceValidate(scene.space()), 1);
        }
    }
    return scene.log();
}

TEST_F(Contract, 16_WorkerThreadsMoveTheGeoms)
{
    const std::vector<Pairs> expected = run_with_workers(SpaceKind::simple);
    const std::vector<Pairs> first = run_with_workers(SpaceKind::predictive);
    ASSERT_EQ(first.size(), expected.size());
    for (std::size_t tick = 0; tick < first.size(); ++tick)
        ASSERT_EQ(unordered(first[tick]), expected[tick]) << "tick " << tick;
    // The sequence is the same every time, though the workers finish in any order.
    EXPECT_EQ(run_with_workers(SpaceKind::predictive), first);
}
} // namespace
} // namespace ode_predictive_space
