// Any bytes as a recording: the reader accepts it, or refuses it and names the line. An accepted recording keeps its promises.

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <unistd.h>

#include <ode_predictive_space/haptics/recording.h>

#include "tests/fuzz/fuzz_target.h"

using namespace ode_predictive_space::haptics;

namespace
{
void expect(bool holds, const char *what)
{
    if (holds)
        return;
    std::fprintf(stderr, "a recording was read in which %s\n", what);
    std::abort();
}

// A file of random bytes can have more.
constexpr std::size_t most_ticks = 20;

void check(const Recording &recording)
{
    expect(recording.ticks.size() <= most_ticks, "there are too many ticks");
    expect(!recording.ticks.empty(), "there is no tick");
    double before = -std::numeric_limits<double>::infinity();
    for (const RecordedTick &tick : recording.ticks)
    {
        const DeviceState &state = tick.state;
        expect(state.time > before, "times do not increase");
        before = state.time;
        expect(state.position.allFinite() && tick.force.allFinite() && state.linear_velocity.allFinite() &&
                   state.angular_velocity.allFinite(),
               "a number is not finite");
        expect(std::abs(state.orientation.norm() - 1) < 1e-6, "an orientation is not of length 1");
    }
}

std::string file_of_process()
{
    const char *folder = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
    return std::string(folder) + "/fuzzed_recording." + std::to_string(getpid());
}
} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const std::string name = file_of_process();
    std::ofstream(name, std::ios::binary)
        .write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
    try
    {
        check(read_recording(name, most_ticks));
    }
    catch (const DeviceError &error)
    {
        const std::string text = error.what();
        expect(error.fault() == DeviceFault::bad_file && text.find("line ") != std::string::npos, "no line is named");
    }
    std::remove(name.c_str());
    return 0;
}
