#include "ode_predictive_space/haptics/recording.h"

#include "ode_predictive_space/haptics/device/at_end.h"
#include "tests/support/error_of.h"
#include "tests/support/scratch.h"

#include <cmath>
#include <sys/stat.h>

namespace ode_predictive_space::haptics
{
namespace
{
DeviceError problem_with(const std::string &file, std::size_t most_ticks = most_recorded_ticks)
{
    const DeviceError error = error_of<DeviceError>([&] { read_recording(file, most_ticks); });
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << "it names the file";
    return error;
}

void expect_bad(const std::string &content, int line, const std::string &complaint)
{
    const ScratchFile file(content);
    const DeviceError problem = problem_with(file.path());
    EXPECT_EQ(problem.fault(), DeviceFault::bad_file);
    EXPECT_PRED_FORMAT2(testing::IsSubstring, "line " + std::to_string(line) + ":", problem.what());
    EXPECT_PRED_FORMAT2(testing::IsSubstring, complaint, problem.what());
}

TEST(Recording, ReadsPlainTrajectoriesOfTum)
{
    const ScratchFile file("# ground truth trajectory\n"
                           "# timestamp tx ty tz qx qy qz qw\n"
                           "1305031098.6659 1.3563 0.6305 1.6380 0.6132 0.5962 -0.3311 -0.3986\n"
                           "\n"
                           "  1305031098.6758\t1.3543 0.6306 1.6360 0.6129 0.5966 -0.3316 -0.3980\r\n");
    const Recording recording = read_recording(file.path());
    ASSERT_EQ(recording.ticks.size(), 2u);
    EXPECT_FALSE(recording.has_forces);
    EXPECT_FALSE(recording.has_velocities);
    EXPECT_FALSE(recording.device);
    const DeviceState &state = recording.ticks[1].state;
    EXPECT_EQ(state.time, 1305031098.6758);
    EXPECT_EQ(state.position, Vector3(1.3543, 0.6306, 1.6360));
    EXPECT_NEAR(state.orientation.x(), 0.6129, 1e-4);
    EXPECT_NEAR(state.orientation.w(), -0.3980, 1e-4);
    EXPECT_NEAR(state.orientation.norm(), 1, 1e-15);
    EXPECT_EQ(state.buttons, 0u);
    EXPECT_EQ(recording.ticks[1].force, Vector3::Zero());
}

TEST(Recording, ReadsALastLineWithoutAnEnd)
{
    const ScratchFile file("0 1 2 3 0.6 0 0 0.8");
    const Recording recording = read_recording(file.path());
    ASSERT_EQ(recording.ticks.size(), 1u);
    const Eigen::Quaterniond &orientation = recording.ticks[0].state.orientation;
    EXPECT_NEAR(orientation.w() / orientation.x(), 0.8 / 0.6, 1e-12);
}

TEST(Recording, ReadsForcesAndButtons)
{
    const ScratchFile file("0 1 2 3 0 0 0 1 4 5 6 7\n1 1 2 3 0 0 0 1 -4e-3 5 6 4294967295\n");
    const Recording recording = read_recording(file.path());
    EXPECT_TRUE(recording.has_forces);
    EXPECT_FALSE(recording.has_velocities);
    EXPECT_EQ(recording.ticks[0].force, Vector3(4, 5, 6));
    EXPECT_EQ(recording.ticks[0].state.buttons, 7u);
    EXPECT_EQ(recording.ticks[1].force, Vector3(-4e-3, 5, 6));
    EXPECT_EQ(recording.ticks[1].state.buttons, 0xffffffffu);
}

TEST(Recording, ReadsWhatTheDeviceCouldDo)
{
    const ScratchFile file("# ode_predictive_space device: 6 3 7.9 1000 5 500 -1 -2 -3 1 2 3 PHANToM Desktop\n"
                           "0 1 2 3 0 0 0 1\n");
    const Recording recording = read_recording(file.path());
    ASSERT_TRUE(recording.device);
    EXPECT_EQ(recording.device->name, "PHANToM Desktop");
    EXPECT_EQ(recording.device->input_axes, 6);
    EXPECT_EQ(recording.device->force_axes, 3);
    EXPECT_EQ(recording.device->max_force, 7.9);
    EXPECT_EQ(recording.device->max_stiffness, 1000);
    EXPECT_EQ(recording.device->max_damping, 5);
    EXPECT_EQ(recording.device->rate, 500);
    EXPECT_EQ(recording.device->workspace.min(), Vector3(-1, -2, -3));
    EXPECT_EQ(recording.device->workspace.max(), Vector3(1, 2, 3));
}

TEST(Recording, NamesTheLineThatCannotBeUnderstood)
{
    const std::string good = "0 1 2 3 0 0 0 1\n";
    expect_bad("", 0, "no tick");
    expect_bad("# nothing but a comment\n", 1, "no tick");
    expect_bad(good + "1 1 2 3 0 0 0\n", 2, "7 numbers where 8, 12 or 18 are expected");
    expect_bad(good + "1 1 2 3 0 0 0 1 2\n", 2, "9 numbers");
    expect_bad(good + "1 1 2 3 0 0 0 1 1 1 1 1 1 1 1 1 1 1 1 1\n", 2, "20 numbers");
    expect_bad(good + "\n1 1 2 3 0 0 0 1 0 0 0 0\n", 3, "12 numbers, and 8 in the lines before");
    expect_bad(good + "1 1 two 3 0 0 0 1\n", 2, "\"two\"");
    expect_bad(good + "1 1 2x 3 0 0 0 1\n", 2, "\"2x\"");
    expect_bad(good + "1 1 1e999 3 0 0 0 1\n", 2, "\"1e999\"");
    expect_bad(good + "1 1 nan 3 0 0 0 1\n", 2, "not finite");
    expect_bad(good + "1 1 2 3 0 0 0 0\n", 2, "length 1");
    expect_bad(good + good, 2, "not later");
    expect_bad("0 1 2 3 0 0 0 1 0 0 0 1.5\n", 1, "\"1.5\"");
    expect_bad("0 1 2 3 0 0 0 1 0 0 0 -1\n", 1, "\"-1\"");
    expect_bad("# ode_predictive_space device: 6 3 7.9\n" + good, 1, "\"\"");
}

std::string of_length(std::size_t characters)
{
    const std::string tick = "0 1 2 3 0 0 0 1";
    return tick + std::string(characters - tick.size(), ' ');
}

TEST(Recording, RefusesLinesThatAreTooLong)
{
    const std::string good = "1 1 2 3 0 0 0 1\n";
    expect_bad(of_length(longest_recorded_line + 1) + "\n" + good, 1, "more than 4096 characters");
    expect_bad(good + "# " + std::string(100 * longest_recorded_line, 'x'), 2, "more than 4096 characters");
    expect_bad(std::string(longest_recorded_line + 1, '\0'), 1, "more than 4096 characters");
}

TEST(Recording, ReadsLinesOfTheGreatestLength)
{
    for (const char *end : {"\n", ""})
    {
        const ScratchFile file("# a comment\n" + of_length(longest_recorded_line) + end);
        EXPECT_EQ(read_recording(file.path()).ticks.size(), 1u);
    }
}

TEST(Recording, RefusesMoreTicksThanAreAskedFor)
{
    const ScratchFile file("0 1 2 3 0 0 0 1\n# a comment\n1 1 2 3 0 0 0 1\n2 1 2 3 0 0 0 1\n");
    EXPECT_EQ(read_recording(file.path(), 3).ticks.size(), 3u);
    const DeviceError problem = problem_with(file.path(), 2);
    EXPECT_EQ(problem.fault(), DeviceFault::bad_file);
    EXPECT_PRED_FORMAT2(testing::IsSubstring, "line 4: more than 2 ticks", problem.what());
}

TEST(Recording, SaysWhyItCannotOpenAFile)
{
    EXPECT_EQ(problem_with("/no/such/folder/run.txt").fault(), DeviceFault::missing_file);
    EXPECT_EQ(problem_with(testing::TempDir()).fault(), DeviceFault::bad_file);
    const ScratchFile locked("0 1 2 3 0 0 0 1\n");
    ASSERT_EQ(chmod(locked.path().c_str(), 0), 0);
    const uid_t user = geteuid();
    ASSERT_TRUE(user != 0 || seteuid(65534) == 0) << "the superuser's rights need no permission";
    const AtEnd restore([user] { EXPECT_EQ(seteuid(user), 0); });
    EXPECT_EQ(problem_with(locked.path()).fault(), DeviceFault::permission_denied);
}

TEST(ForceError, MeasuresTheDifference)
{
    const ForceError error = compare_forces({{3, 0, 0}, {0, 4, 0}}, {{3, 0, 1}, {3, 0, 0}});
    EXPECT_DOUBLE_EQ(error.rms, std::sqrt((1 + 25) / 2.0));
    EXPECT_DOUBLE_EQ(error.max, 5);
    EXPECT_DOUBLE_EQ(error.relative, std::sqrt(26 / 25.0));
}

TEST(ForceError, WithoutARecordedForceAnyOtherIsInfinitelyMore)
{
    EXPECT_EQ(compare_forces({Vector3::Zero()}, {Vector3::Zero()}).relative, 0);
    EXPECT_EQ(compare_forces({Vector3::Zero()}, {Vector3(1, 0, 0)}).relative, std::numeric_limits<double>::infinity());
}

TEST(ForceError, ComparesOnlyWhatIsOfOneLength)
{
    EXPECT_THROW(compare_forces({}, {}), std::invalid_argument);
    EXPECT_THROW(compare_forces({Vector3::Zero()}, {}), std::invalid_argument);
}
} // namespace
} // namespace ode_predictive_space::haptics
