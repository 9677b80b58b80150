// Runs of a device in a text file: writing them while the servo loop runs, reading them back, and replaying them as a device.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RECORDING_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RECORDING_H

#include "ode_predictive_space/haptics/device.h"
#include "ode_predictive_space/haptics/exchange.h"

#include <atomic>
#include <condition_variable>
#include <fstream>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace ode_predictive_space::haptics
{
/// One tick of a run.
///
/// In a file it is a line of numbers between blanks:
///     t tx ty tz qx qy qz qw fx fy fz buttons vx vy vz wx wy wz
/// s, m, quaternion, N, bits, m/s, rad/s, in the device's own frame; docs/haptics/guide.md has the rest of the format. Numbers are
/// printed so that reading gives back the same doubles.
struct RecordedTick
{
    DeviceState state;               ///< its time: what read() was given
    Vector3 force = Vector3::Zero(); ///< N; what was written after that
};

/// A run that was read from a file.
struct Recording
{
    std::optional<Capabilities> device; ///< of which it is a run, if the file tells
    std::string law;                    ///< ForceLaw::name(); empty if the file does not tell
    std::vector<RecordedTick> ticks;    ///< at least one; their times increase
    bool has_forces = false;            ///< and buttons; otherwise these are zero
    bool has_velocities = false;        ///< otherwise these are zero
};

/// The most ticks that are read unless more are asked for: 2 hours 46 minutes at 1 kHz, about 2 GB of memory.
constexpr std::size_t most_recorded_ticks = 10'000'000;

/// The most characters of a line, without its end. The longest line of numbers that a Recorder writes has less than 500.
constexpr std::size_t longest_recorded_line = 4096;

/// Read a run. Quaternions that are of length 1 but for the few digits that they were written with are made so. The memory used is
/// bounded whatever is in the file.
/// @param most_ticks a file with more is bad.
/// @throws DeviceError: missing_file, permission_denied; bad_file, which names the line.
Recording read_recording(const std::string &file, std::size_t most_ticks = most_recorded_ticks);

/// Writes a run to a file while the servo loop runs.
///
/// add() puts a tick into a buffer that is made with the recorder (some 200 bytes per tick); flush() writes what is in it to the
/// file. The recorder's own thread, which does that 20 times a second, inherits the scheduling of the thread that makes the
/// recorder: make it before that one becomes a real-time thread. Ticks that find the buffer full are lost; a comment in the file
/// says how many are missing and where.
class Recorder
{
public:
    /// Who calls flush(), beside close().
    enum class Flush
    {
        by_itself, ///< a thread of the recorder's
        by_caller
    };

    /// Make the file, or empty it.
    ///
    /// @param device what the device can do: a replay must have the same limits and workspace to give the same forces. Of a
    /// name of thousands of characters, the end is not written: see longest_recorded_line.
    /// @param law ForceLaw::name(): one line. Without it, a replay does not know by which law the forces were made.
    /// @param capacity of the buffer, in ticks, > 0: one minute of 1 kHz by default.
    /// @throws DeviceError: missing_file (no such folder), permission_denied. std::invalid_argument.
    Recorder(const std::string &file, const Capabilities &device, const std::string &law,
             Flush flush = Flush::by_itself, std::size_t capacity = 60000);

    /// The same, and the file names no law.
    Recorder(const std::string &file, const Capabilities &device, Flush flush = Flush::by_itself,
             std::size_t capacity = 60000)
        : Recorder(file, device, std::string(), flush, capacity)
    {}

    /// As close(), but what cannot be written is lost without a word.
    ~Recorder();
    Recorder(const Recorder &) = delete;
    Recorder &operator=(const Recorder &) = delete;

    /// Record one tick. From one thread, the servo loop's: no memory is allocated, nothing is waited for.
    ///
    /// @param time what read() was given; the state's own is not recorded.
    /// @return false if the tick is lost: the buffer is full, the file cannot be written (a full disk), or reading it would fail, as a number is not finite, the
    /// orientation not of length 1, or the time not later than that of the tick before.
    bool add(double time, const DeviceState &state, const Vector3 &force) noexcept;

    /// Write what has been added so far. From any thread; it waits for the disk.
    ///
    /// @throws DeviceError (failed) if the file cannot be written.
    void flush();

    /// Write the rest and close the file. add() must not be called at the same time or after that.
    ///
    /// @throws DeviceError (failed) if some of the run could not be written, now or before.
    void close();

    /// Ticks so far that are not in the file and will not be; from any thread. When the file cannot be written, those that were
    /// waiting are lost, too.
    std::size_t lost() const { return failed_ ? lost_ + (recorded_ - on_disk_) : lost_.load(); }
    /// Ticks so far, without those that are lost; from any thread.
    std::size_t recorded() const { return failed_ ? on_disk_ : recorded_; }

private:
    struct Entry
    {
        RecordedTick tick;
        std::size_t lost_before; ///< of all ticks up to this one
    };

    void write_header(const Capabilities &device, const std::string &law);
    void write_entries();
    void append_loss(std::size_t lost);
    void write_text();
    void check_file() const;
    void close_file();
    void flush_often();

    std::string name_;
    Queue<Entry> buffer_;
    std::atomic<std::size_t> recorded_{0};                        ///< ticks; only add() changes it
    std::atomic<std::size_t> lost_{0};                            ///< the same
    std::atomic<std::size_t> on_disk_{0};                         ///< ticks; only the thread that writes changes it
    std::atomic<bool> failed_{false};                             ///< the file cannot be written
    double last_time_ = -std::numeric_limits<double>::infinity(); ///< s; of add()
    std::mutex file_mutex_;                                       ///< guards what follows, up to the thread
    std::ofstream file_;
    std::size_t written_ = 0; ///< ticks
    std::size_t losses_written_ = 0;
    std::string text_; ///< not yet written
    bool stopping_ = false;
    std::condition_variable stop_;
    std::thread thread_;
};

/// How far a rendered force was from a recorded one (Ruffaldi, Morris, Edmunds, Barbagli and Pai, Haptics Symposium 2006).
struct ForceError
{
    double rms = 0;      ///< N; root of the mean square of the difference's length
    double max = 0;      ///< N; the largest difference's length
    double relative = 0; ///< rms over the root mean square of the recorded force; 0 if both are 0
};

/// Compare tick by tick.
///
/// @throws std::invalid_argument if one is longer than the other, or both are empty.
ForceError compare_forces(const std::vector<Vector3> &recorded, const std::vector<Vector3> &rendered);

/// The handle moves as in the recording, from its first tick on; the loop's clock need not show the same time.
///
/// At recorded times, within a nanosecond, the states are those recorded, bit by bit: a loop that reads at the same times
/// gets the same input. In between, positions follow the cubic Hermite curve and orientations the great arc between two
/// ticks, so that nothing jumps at any rate. Velocities are those recorded, or, where there are none, those of parabolas
/// through three ticks; in between, the linear velocity is the derivative of the curve, and the angular velocity changes
/// evenly. Buttons are those of the tick before.
///
/// A gap of more than 0.25 s is crossed on a straight line, from rest to rest. The capabilities are those of the device that was
/// recorded, if the file tells.
///
/// After the last tick the handle rests where it is; status() is then not ready and says why. Forces are accepted and have
/// no effect.
class ReplayDevice : public SoftwareDevice
{
public:
    /// The file is read by open(), which throws what read_recording() throws.
    explicit ReplayDevice(const std::string &file);

    /// Replay a run that is already there.
    ///
    /// @throws std::invalid_argument when it has no ticks.
    explicit ReplayDevice(Recording recording);

    /// With the velocities that it is replayed with. Empty before the first open() of a file.
    const Recording &recording() const { return recording_; }

protected:
    void start() override;
    DeviceState move_to(double seconds) override;
    std::string idle_reason() const override;

private:
    void take_in(Recording recording);
    double seconds_at(std::size_t tick) const;
    DeviceState between(double seconds) const;

    std::string file_; ///< empty when there is none
    Recording recording_;
    std::size_t tick_ = 0; ///< the last one that was reached
    bool ended_ = false;
};
} // namespace ode_predictive_space::haptics

#endif
