// No force may remain after an end of the program that runs no destructors. Each end is tried in a separate process.

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/penalty_law.h"

#include "tests/haptics/safety/program_end_fixture.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/signal_disposition.h"

#include <atomic>
#include <cstdlib>
#include <exception>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
// They are parts of the tests' names.
using RunKind = std::string_view;
using Place = std::string_view;

constexpr RunKind all_runs[] = {"ByHand", "OneThread", "TwoThreads"};
constexpr Place all_places[] = {"Near", "Advance", "Notice", "Law", "Material", "Recorder", "Read", "Write", "Clock"};

/// A device or a callback may throw anything, not only standard exceptions.
struct Trouble
{};

struct Way
{
    const char *name;
    void (*end)();
    bool exits;
};

const Way all_ways[] = {
    {"exit", [] { std::exit(3); }, true},           {"quick_exit", [] { std::quick_exit(3); }, true},
    {"terminate", [] { std::terminate(); }, false}, {"exception", [] { throw Trouble(); }, false},
    {"abort", [] { std::abort(); }, false},
};

class OwnClock : public MonotonicClock
{
public:
    explicit OwnClock(std::function<void()> at_now) : at_now_(std::move(at_now)) {}

    double now() const override
    {
        at_now_();
        return MonotonicClock::now();
    }

private:
    std::function<void()> at_now_;
};

class OwnLaw : public ForceLaw
{
public:
    explicit OwnLaw(std::function<double()> factor) : factor_(std::move(factor)) {}

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override
    {
        law_.forces(tool, touches, dt, forces);
        const double factor = factor_();
        for (Vector3 &force : forces)
            force *= factor;
    }

    void reset() override { law_.reset(); }
    Material material() const override { return law_.material(); }

private:
    PenaltyLaw law_;
    std::function<double()> factor_;
};

class LeaningProgram
{
public:
    using Callback = std::function<void(Place)>; ///< called in each place while there is a force

    LeaningProgram(SharedForce &force, Callback callback)
        : force_(force), callback_(std::move(callback)), device_(force), clock_([this] { at("Clock"); })
    {
        dCreatePlane(world_.space, 0, 0, 1, 0);
        world_.on_pair = [this](dGeomID, dGeomID) { at("Near"); };
        device_.before_read = [this] { at("Read"); };
        device_.after_write = [this] { at("Write"); };
    }

    /// Runs half a second by hand, or up to 20 s by the machine's clock, because a busy machine is slow.
    void run(RunKind run)
    {
        HapticProbe probe(device_, world_.space, 0.01, rendering());
        probe.set_materials([this](dGeomID) {
            at("Material");
            return std::nullopt;
        });
        probe.set_recorder([this](const RenderedTick &) { at("Recorder"); });
        run == "ByHand" ? run_by_hand(probe) : run_loop(probe, run == "TwoThreads");
    }

private:
    void at(Place place)
    {
        if (force_.now > present_force)
            callback_(place);
    }

    RenderSettings rendering()
    {
        RenderSettings settings;
        settings.safety = SafetyLimits::of(desktop_capabilities());
        settings.safety->ramp_time = 0;
        settings.notice = [this](const Notice &) { at("Notice"); };
        settings.law = std::make_shared<OwnLaw>([this] {
            at("Law");
            return force_.now > present_force ? 1e6 : 1; // above the device's maximum: worth a notice
        });
        return settings;
    }

    void run_by_hand(HapticProbe &probe)
    {
        for (int tick = 0; tick < 500; ++tick)
        {
            world_.run(probe, 1);
            at("Advance");
        }
    }

    void run_loop(HapticProbe &probe, bool decoupled)
    {
        HapticLoop loop(probe, simulated(clock_, 20, decoupled));
        loop.run(world_.work(probe, [this](double) { at("Advance"); }));
    }

    SharedForce &force_;
    Callback callback_;
    const OdeUse ode_;
    ProbeWorld world_;
    SharedDevice device_;
    OwnClock clock_;
};

class LeaningProgramEnds : public ProgramEnds
{
protected:
    ProgramEnd end_in(RunKind run, Place place, const std::function<void()> &end)
    {
        return end_of_pressing([&] {
            // Two threads read the clock. Only one may end the program, because exit() in two at once is undefined.
            std::atomic<std::thread::id> ending{};
            LeaningProgram program(force_, [&](Place here) {
                std::thread::id first{};
                const std::thread::id me = std::this_thread::get_id();
                if (here == place && (ending.compare_exchange_strong(first, me) || first == me))
                    end();
            });
            program.run(run);
        });
    }
};

using EndPlace = std::tuple<RunKind, Place>;

class ProgramEndTest : public LeaningProgramEnds, public testing::WithParamInterface<EndPlace>
{};

TEST_P(ProgramEndTest, LeavesNoForceAndAMessage)
{
    const auto [run, place] = GetParam();
    const bool in_device = place == "Read" || place == "Write";
    for (const Way &way : all_ways)
    {
        SCOPED_TRACE(way.name);
        if (in_device && std::string_view(way.name) == "exception")
            continue; // no end of a program: see WhatADeviceThrowsIsADevicesFaultWhateverItIs
        const ProgramEnd end = end_in(run, place, way.end);
        if (way.exits)
        {
            EXPECT_TRUE(end.exited_with(3)) << end.status << (end.hung ? " hung" : "");
        }
        else
            expect_abort(end);
        expect_zero();
    }
}

/// Without a loop there is no clock.
std::vector<EndPlace> all_end_places()
{
    std::vector<EndPlace> places;
    for (const RunKind run : all_runs)
    {
        for (const Place place : all_places)
            if (run != "ByHand" || place != "Clock")
                places.emplace_back(run, place);
    }
    return places;
}

INSTANTIATE_TEST_SUITE_P(Places, ProgramEndTest, testing::ValuesIn(all_end_places()), [](const auto &info) {
    return std::string(std::get<0>(info.param)).append(std::get<1>(info.param));
});

class ProgramEndRunTest : public LeaningProgramEnds, public testing::WithParamInterface<RunKind>
{};

INSTANTIATE_TEST_SUITE_P(Runs, ProgramEndRunTest, testing::ValuesIn(all_runs),
                         [](const auto &info) { return std::string(info.param); });

TEST_P(ProgramEndRunTest, ExitInAnotherThreadLeavesNoForce)
{
    const ProgramEnd end = end_in(GetParam(), "Advance", [] { std::thread([] { std::exit(3); }).join(); });
    EXPECT_TRUE(end.exited_with(3));
    expect_zero();
}

TEST_P(ProgramEndRunTest, AnExceptionThatAThreadDoesNotCatchLeavesNoForce)
{
    const ProgramEnd end =
        end_in(GetParam(), "Advance", [] { std::thread([] { throw std::runtime_error("not caught"); }).join(); });
    expect_abort(end);
    EXPECT_TRUE(end.says("not caught"));
    expect_zero();
}

TEST_F(LeaningProgramEnds, SigquitEndsALoopAndLeavesNoForce)
{
    const SignalDisposition ending(SIGQUIT);
    for (const RunKind run : {"OneThread", "TwoThreads"})
    {
        EXPECT_TRUE(end_in(run, "Advance", [] { std::raise(SIGQUIT); }).exited_with(returned));
        expect_zero();
    }
}

TEST_P(ProgramEndRunTest, WhatADeviceThrowsIsADevicesFaultWhateverItIs)
{
    for (const Place place : {"Read", "Write"})
    {
        const ProgramEnd end = end_in(GetParam(), place, [ended = false]() mutable {
            if (!std::exchange(ended, true))
                throw Trouble();
            std::exit(3); // with a force again
        });
        EXPECT_TRUE(end.exited_with(3)) << end.messages;
        expect_zero();
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
