#include "ode_predictive_space/haptics/recording.h"

#include "ode_predictive_space/haptics/virtual_device.h"
#include "tests/haptics/support/constants.h"
#include "tests/support/error_of.h"
#include "tests/support/scratch.h"

#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
Vector3 path(double t)
{
    return {0.1 * std::sin(3 * t), 0.05 * std::cos(5 * t), 0.02 * t};
}

Vector3 path_velocity(double t)
{
    return {0.3 * std::cos(3 * t), -0.25 * std::sin(5 * t), 0.02};
}

Quaternion turn(double t)
{
    return Quaternion(Eigen::AngleAxisd(2 * t, Vector3(0, 0.6, 0.8)));
}

Recording smooth_run(double start, double period, int count)
{
    Recording recording;
    for (int i = 0; i < count; ++i)
    {
        RecordedTick tick;
        tick.state.time = start + i * period;
        tick.state.position = path(i * period);
        tick.state.orientation = turn(i * period);
        tick.state.buttons = i % 2;
        recording.ticks.push_back(tick);
    }
    return recording;
}

Vector3 wall_force(const DeviceState &state)
{
    const double depth = -state.position.x();
    return depth > 0 ? Vector3(800 * depth - 2 * state.linear_velocity.x(), 0, 0) : Vector3::Zero();
}

struct TicksOfRun
{
    std::vector<DeviceState> states;
    std::vector<Vector3> forces;
};

TicksOfRun run_of(Device &device, double start, int ticks, Recorder *recorder)
{
    TicksOfRun run;
    device.open();
    for (int i = 0; i < ticks; ++i)
    {
        const double time = start + i * dt;
        run.states.push_back(device.read(time));
        run.forces.push_back(wall_force(run.states.back()));
        device.write({run.forces.back(), Vector3::Zero()});
        if (recorder)
            recorder->add(time, run.states.back(), run.forces.back());
    }
    device.close();
    return run;
}

void expect_equal(const TicksOfRun &a, const TicksOfRun &b)
{
    ASSERT_EQ(a.states.size(), b.states.size());
    for (std::size_t i = 0; i < a.states.size(); ++i)
    {
        ASSERT_EQ(a.states[i].position, b.states[i].position) << "tick " << i;
        ASSERT_EQ(a.states[i].linear_velocity, b.states[i].linear_velocity) << "tick " << i;
        ASSERT_EQ(a.states[i].orientation.coeffs(), b.states[i].orientation.coeffs()) << "tick " << i;
        ASSERT_EQ(a.forces[i], b.forces[i]) << "tick " << i;
    }
}

TEST(ReplayDevice, GivesTheSameForcesAsTheRecordedRun)
{
    const ScratchFile file;
    VirtualDevice device({}, [](double t) { return Vector3(0.02 * std::cos(7 * t), 0, 0); });
    Recorder recorder(file.path(), device.capabilities(), Recorder::Flush::by_caller);
    const TicksOfRun original = run_of(device, 17.3, 2000, &recorder);
    recorder.close();

    ReplayDevice replay(file.path());
    const TicksOfRun again = run_of(replay, 17.3, 2000, nullptr);
    expect_equal(again, original);
    EXPECT_EQ(compare_forces(original.forces, again.forces).max, 0);
    expect_equal(run_of(replay, 17.3, 2000, nullptr), original);  // opened again
    expect_equal(run_of(replay, 40000, 2000, nullptr), original); // on a clock that shows another time

    std::vector<Vector3> recorded;
    for (const RecordedTick &tick : replay.recording().ticks)
        recorded.push_back(tick.force);
    EXPECT_EQ(compare_forces(recorded, again.forces).max, 0);
    EXPECT_GT(compare_forces(recorded, std::vector<Vector3>(2000, Vector3::Zero())).max, 1) << "there were forces";
}

TEST(ReplayDevice, IsLikeTheDeviceThatWasRecorded)
{
    Recording recording = smooth_run(0, dt, 10);
    recording.device = device_preset("Falcon");
    ReplayDevice device(recording);
    EXPECT_EQ(device.capabilities().max_force, 8);
    EXPECT_EQ(device.capabilities().workspace.max(), Vector3::Constant(0.04));
    EXPECT_NE(device.capabilities().name.find("replay"), std::string::npos);
}

TEST(ReplayDevice, WithoutADeviceItsWorkspaceIsThatOfTheMotion)
{
    ReplayDevice device(smooth_run(0, 0.01, 500));
    EXPECT_EQ(device.capabilities().force_axes, 0);
    EXPECT_NEAR(device.capabilities().rate, 100, 1e-6);
    EXPECT_NEAR(device.capabilities().workspace.max().x(), 0.1, 0.002);
    EXPECT_NEAR(device.capabilities().workspace.min().z(), -0.001, 1e-9) << "the margin";
    EXPECT_TRUE(device.capabilities().workspace.contains(path(1.23)));
}

TEST(ReplayDevice, FollowsTheMotionBetweenTheRecordedTimes)
{
    ReplayDevice device(smooth_run(1305031098.6, 0.01, 300));
    device.open();
    for (double time = 0; time < 2.9; time += 0.00037)
    {
        const DeviceState state = device.read(time);
        const bool inside = time > 0.01 && time < 2.8; // at the ends there are no parabolas
        // Times since 1970 have steps of a quarter of a microsecond.
        ASSERT_LT((state.position - path(time)).norm(), inside ? 3e-6 : 1e-4) << "at " << time << " s";
        ASSERT_LT((state.linear_velocity - path_velocity(time)).norm(), inside ? 5e-3 : 5e-2) << "at " << time << " s";
        ASSERT_LT(state.orientation.angularDistance(turn(time)), 1e-5);
        ASSERT_LT((state.angular_velocity - 2 * Vector3(0, 0.6, 0.8)).norm(), 1e-3);
        const double ticks = time / 0.01;
        const bool at_a_tick = std::abs(ticks - std::round(ticks)) < 1e-3;
        ASSERT_TRUE(at_a_tick || state.buttons == static_cast<std::uint32_t>(ticks) % 2) << "at " << time << " s";
    }
}

TEST(ReplayDevice, VelocityIsTheDerivativeOfThePosition)
{
    ReplayDevice device(smooth_run(0, 0.02, 100));
    device.open();
    const double step = 1e-6;
    for (double time = 0.0031; time < 1.9; time += 0.0093)
    {
        const Vector3 before = device.read(time - step).position;
        const Vector3 velocity = device.read(time).linear_velocity;
        const Vector3 after = device.read(time + step).position;
        ASSERT_LT(((after - before) / (2 * step) - velocity).norm(), 1e-6) << "at " << time << " s";
    }
}

TEST(ReplayDevice, VelocityAtUnevenTimesIsThatOfTheParabola)
{
    Recording recording;
    for (const double time : {0.0, 0.01, 0.04, 0.05, 0.11})
    {
        RecordedTick tick;
        tick.state.time = time;
        tick.state.position = time * time * Vector3(1, 2, 3);
        recording.ticks.push_back(tick);
    }
    ReplayDevice device(recording);
    device.open();
    device.read(0);
    for (const double time : {0.01, 0.04, 0.05})
        EXPECT_LT((device.read(time).linear_velocity - 2 * time * Vector3(1, 2, 3)).norm(), 1e-12) << time;
}

TEST(ReplayDevice, CrossesAGapOnAStraightLine)
{
    Recording recording;
    recording.has_velocities = true;
    for (const double time : {0.0, 10.0})
    {
        RecordedTick tick;
        tick.state.time = time;
        tick.state.position.x() = time / 100;
        tick.state.linear_velocity = Vector3(1, 2, 3); // would carry it metres away in this time
        recording.ticks.push_back(tick);
    }
    ReplayDevice device(recording);
    device.open();
    for (double time = 0; time <= 10; time += 0.01)
    {
        const Vector3 position = device.read(time).position;
        ASSERT_TRUE(position.x() >= 0 && position.x() <= 0.1 + 1e-12) << "at " << time << " s";
        ASSERT_EQ(position.y(), 0);
    }
}

TEST(ReplayDevice, StaysAtTheEndAndSaysSo)
{
    ReplayDevice device(smooth_run(0, 0.01, 11));
    device.open();
    EXPECT_TRUE(device.status().ready);
    EXPECT_EQ(device.read(0).position, path(0));
    EXPECT_EQ(device.read(0.1).position, path(0.1));
    EXPECT_TRUE(device.status().ready);
    const DeviceState state = device.read(0.2);
    EXPECT_EQ(state.position, path(0.1));
    EXPECT_EQ(state.linear_velocity, Vector3::Zero());
    EXPECT_EQ(state.angular_velocity, Vector3::Zero());
    EXPECT_TRUE(device.status().open);
    EXPECT_FALSE(device.status().ready);
    EXPECT_NE(device.status().explanation.find("ended"), std::string::npos);
    device.close();
    device.open();
    EXPECT_TRUE(device.status().ready);
    EXPECT_EQ(device.read(7).position, path(0));
}

TEST(ReplayDevice, OneTickIsAHandThatRests)
{
    ReplayDevice device(smooth_run(3, 1, 1));
    EXPECT_EQ(device.capabilities().rate, Capabilities().rate);
    device.open();
    EXPECT_EQ(device.read(0).position, path(0));
    EXPECT_EQ(device.read(0).linear_velocity, Vector3::Zero());
    EXPECT_EQ(device.read(1).position, path(0));
}

TEST(ReplayDevice, OpenSaysWhatIsWrongWithTheFile)
{
    ReplayDevice missing("/no/such/file.txt");
    EXPECT_EQ(error_of<DeviceError>([&] { missing.open(); }).fault(), DeviceFault::missing_file);
    EXPECT_FALSE(missing.status().open);
    const ScratchFile file("0 1 2\n");
    ReplayDevice bad(file.path());
    EXPECT_THROW(bad.open(), DeviceError);
    EXPECT_THROW(ReplayDevice(Recording{}), std::invalid_argument);
}
} // namespace
} // namespace ode_predictive_space::haptics
