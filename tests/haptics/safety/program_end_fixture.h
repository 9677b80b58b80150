// The forces that a dying program leaves on its devices.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SAFETY_PROGRAM_END_FIXTURE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SAFETY_PROGRAM_END_FIXTURE_H

#include "tests/haptics/support/child_program.h"
#include "tests/haptics/support/scripted_device.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <gtest/gtest.h>
#include <sys/mman.h>

namespace ode_predictive_space::haptics
{
constexpr double present_force = 0.1; // N; larger forces count as present

/// The force of a device in another process.
struct SharedForce
{
    std::atomic<double> now{0};  ///< N
    std::atomic<double> most{0}; ///< N

    void set(double newtons)
    {
        now = newtons;
        most = std::max(most.load(), newtons);
    }
};

/// Moves in and out of the plane z = 0, so that a stall of the machine costs one touch only.
inline Vector3 in_and_out(double seconds)
{
    return {0, 0, 0.01 + 0.002 * std::cos(60 * seconds)};
}

class SharedDevice : public ScriptedDevice
{
public:
    explicit SharedDevice(SharedForce &force) : ScriptedDevice(&in_and_out), force_(force) {}

    void close() noexcept override
    {
        ScriptedDevice::close();
        force_.set(0);
    }

    void write(const Wrench &wrench) override
    {
        ScriptedDevice::write(wrench);
        force_.set(wrench.force.norm());
        if (after_write)
            after_write();
    }

    std::function<void()> after_write; ///< called within the driver; may be empty

private:
    SharedForce &force_;
};

class ProgramEnds : public testing::Test
{
protected:
    ProgramEnds()
        : memory_(mmap(nullptr, 2 * sizeof(SharedForce), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
          force_(*new (memory_) SharedForce), second_force_(*new (&force_ + 1) SharedForce)
    {}
    ~ProgramEnds() override { munmap(memory_, 2 * sizeof(SharedForce)); }

    ProgramEnd end_of_pressing(const std::function<void()> &program)
    {
        for (SharedForce *force : {&force_, &second_force_})
        {
            force->now = 0;
            force->most = 0;
        }
        return end_of(program);
    }

    void expect_zero() { expect_zero(force_); }

    static void expect_zero(const SharedForce &force)
    {
        EXPECT_GT(force.most, present_force) << "it was there";
        EXPECT_EQ(force.now, 0);
    }

    static void expect_abort(const ProgramEnd &end)
    {
        EXPECT_TRUE(end.died_of(SIGABRT)) << end.status << (end.hung ? " hung" : "");
        EXPECT_TRUE(end.says("The program aborts: no force any more")) << end.messages;
    }

private:
    void *memory_;

protected:
    SharedForce &force_;
    SharedForce &second_force_;
};
} // namespace ode_predictive_space::haptics

#endif
