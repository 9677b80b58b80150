// Logs the servo's ticks for the recording, its comparison with an earlier one and the chart, and the durations of scene steps.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_SERVO_LOG_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_SERVO_LOG_H

#include "ode_predictive_space/haptics/exchange.h"
#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/renderer.h"
#include "ode_predictive_space/recording/bounded_series.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace ode_predictive_space::demo
{
/// The largest values of some ticks.
struct ServoColumn
{
    double force = 0;   ///< N; as written to the device
    double period = 0;  ///< s; from one tick to the next
    double compute = 0; ///< s; of a step of the scene
};

struct ServoChart
{
    static constexpr std::size_t columns = 640;
    std::array<ServoColumn, columns> ring{};
    std::uint64_t made = 0; ///< column i is at i modulo columns
};

struct ServoTotals
{
    std::uint64_t ticks = 0;
    std::uint64_t ticks_with_force = 0;
    double force_sum = 0;               ///< N, over the ticks with force
    double max_force = 0;               ///< N
    recording::BoundedSeries forces{};  ///< N
    recording::BoundedSeries periods{}; ///< s; from the second tick on
};

/// For the servo's thread, unless noted.
class ServoLog
{
public:
    static constexpr double column_seconds = 0.01;

    /// @param rate Hz; of the servo. @param record_file empty: no recording. @param keep_forces whether forces() is needed.
    /// @throws haptics::DeviceError when the file cannot be created.
    ServoLog(double rate, const std::string &record_file, const haptics::Capabilities &device, const std::string &law,
             bool keep_forces);

    void add(const haptics::RenderedTick &tick);

    /// The thread that steps the scene calls this.
    void step_took(double seconds);

    /// The latest columns. One other thread may call this.
    const ServoChart &chart();

    /// Valid after the end.
    const ServoTotals &totals() const { return totals_; }
    const std::vector<haptics::Vector3> &forces() const { return forces_; } ///< N
    std::size_t lost_in_recording() const { return recorder_ ? recorder_->lost() : 0; }

    /// Call after the end. @throws haptics::DeviceError when the recording could not be written.
    void close();

private:
    void add_to_chart(double force);

    int ticks_per_column_;
    std::unique_ptr<haptics::Recorder> recorder_;
    bool keep_forces_;
    std::vector<haptics::Vector3> forces_;
    ServoTotals totals_;
    haptics::MonotonicClock clock_;
    double last_tick_ = 0; ///< s
    ServoColumn column_;
    std::atomic<double> longest_step_{0};
    ServoChart ring_;
    haptics::Snapshot<ServoChart> chart_;
};
} // namespace ode_predictive_space::demo

#endif
