// Recordings of a device in text files: writing during a run, reading, and replay as a device.

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
/// s, m, quaternion, N, bits, m/s, rad/s, in the device's own frame. Numbers are printed so that reading gives back the same
/// doubles. Two comments describe the device and the law:
///     # ode_predictive_space device: <input axes> <force axes> <max force> <stiffness> <damping> <rate> <min xyz> <max xyz> <name>
///     # ode_predictive_space law: <proxy, penalty or custom>
struct RecordedTick
{
    DeviceState state;               ///< its time is that of read()
    Vector3 force = Vector3::Zero(); ///< N; written after it
};

/// A run that was read from a file.
struct Recording
{
    std::optional<Capabilities> device; ///< recorded device, if the file names it
    std::string law;                    ///< ForceLaw::name(), or empty
    std::vector<RecordedTick> ticks;    ///< at least one, with increasing times
    bool has_forces = false;            ///< and buttons; otherwise zero
    bool has_velocities = false;        ///< otherwise zero
};

/// Default limit of ticks that are read: 2 h 46 min at 1 kHz, about 2 GB of memory.
constexpr std::size_t most_recorded_ticks = 10'000'000;

/// Limit of characters of a line, without its end. A Recorder's lines of numbers have less than 500.
constexpr std::size_t longest_recorded_line = 4096;

/// Reads a recording. Quaternions whose length is 1 except for few digits are normalised. Memory is bounded for any
/// file.
/// @param most_ticks limit of ticks; a larger file is bad.
/// @throws DeviceError: missing_file, permission_denied; bad_file, which names the line.
Recording read_recording(const std::string &file, std::size_t most_ticks = most_recorded_ticks);

/// Writes a recording during a run.
///
/// add() stores a tick in a buffer of fixed size (some 200 bytes per tick); flush() writes it to the file. The
/// recorder's thread flushes 20 times a second; it inherits the scheduling of the creating thread, so create the
/// recorder before that becomes a real-time thread. Ticks that find the buffer full are lost, and a comment in the file
/// says how many.
class Recorder
{
public:
    /// The caller of flush(), beside close().
    enum class Flush
    {
        by_itself, ///< the recorder's thread
        by_caller
    };

    /// Creates or empties the file.
    ///
    /// @param device capabilities; a replay needs the same limits and workspace for the same forces. A name beyond
    ///         longest_recorded_line is cut off.
    /// @param law ForceLaw::name(), one line; may be empty.
    /// @param capacity of the buffer, in ticks, > 0: one minute of 1 kHz by default.
    /// @throws DeviceError: missing_file (no such folder), permission_denied. std::invalid_argument.
    Recorder(const std::string &file, const Capabilities &device, const std::string &law,
             Flush flush = Flush::by_itself, std::size_t capacity = 60000);

    /// Makes a recorder whose file names no law.
    Recorder(const std::string &file, const Capabilities &device, Flush flush = Flush::by_itself,
             std::size_t capacity = 60000)
        : Recorder(file, device, std::string(), flush, capacity)
    {}

    /// Closes the file, and ignores errors.
    ~Recorder();
    Recorder(const Recorder &) = delete;
    Recorder &operator=(const Recorder &) = delete;

    /// Records a tick. For one thread, the servo's; neither allocates nor waits.
    ///
    /// @param time s, of read(); the state's own is not recorded. @param force N, as written.
    /// @return false for a lost tick: the buffer is full, the file cannot be written (a full disk), a number is not
    ///         finite, the orientation is not of length 1, or the time is not later than before.
    bool add(double time, const DeviceState &state, const Vector3 &force) noexcept;

    /// Writes all added ticks. From any thread; waits for the disk.
    ///
    /// @throws DeviceError (failed) if the file cannot be written.
    void flush();

    /// Writes the rest and closes the file. add() must not be called during or after it.
    ///
    /// @throws DeviceError (failed) if a part could not be written, now or before.
    void close();

    /// Number of lost ticks; from any thread. A file that cannot be written loses the buffered ticks, too.
    std::size_t lost() const { return failed_ ? lost_ + (recorded_ - on_disk_) : lost_.load(); }
    /// Number of recorded ticks, without lost ones; from any thread.
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

/// Difference of rendered and recorded forces (Ruffaldi, Morris, Edmunds, Barbagli and Pai, Haptics Symposium 2006).
struct ForceError
{
    double rms = 0;      ///< N; root mean square of the difference's length
    double max = 0;      ///< N; maximum of the difference's length
    double relative = 0; ///< rms over the root mean square of the recorded force; 0 if both are 0
};

/// Compares forces (N) tick by tick.
///
/// @throws std::invalid_argument for different or zero lengths.
ForceError compare_forces(const std::vector<Vector3> &recorded, const std::vector<Vector3> &rendered);

/// A device whose handle moves as in a recording, from its first tick, at any time of the loop's clock.
///
/// At recorded times, within a nanosecond, states are equal to the recorded ones bit by bit. In between, positions
/// follow the cubic Hermite curve and orientations the great arc, so that they are continuous at any rate. Without
/// recorded velocities, those of parabolas through three ticks are used; in between, the linear velocity is the
/// derivative of the curve, and the angular velocity is interpolated. Buttons are those of the tick before.
///
/// A gap of more than 0.25 s is crossed on a straight line, from rest to rest. The capabilities are those of the
/// recorded device, if the file names it.
///
/// After the last tick the handle stays in place, and status() is not ready. Forces have no effect.
class ReplayDevice : public SoftwareDevice
{
public:
    /// Sets the file, which open() reads; it throws as read_recording().
    explicit ReplayDevice(const std::string &file);

    /// Replays a recording from memory.
    ///
    /// @throws std::invalid_argument for a recording without ticks.
    explicit ReplayDevice(Recording recording);

    /// The recording, with its replayed velocities; empty before the first open() of a file.
    const Recording &recording() const { return recording_; }

protected:
    void start() override;
    DeviceState move_to(double seconds) override;
    std::string idle_reason() const override;

private:
    void take_in(Recording recording);
    double seconds_at(std::size_t tick) const;
    DeviceState between(double seconds) const;

    std::string file_; ///< empty for a recording from memory
    Recording recording_;
    std::size_t tick_ = 0; ///< the last reached tick
    bool ended_ = false;
};
} // namespace ode_predictive_space::haptics

#endif
