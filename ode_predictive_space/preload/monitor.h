#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_MONITOR_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_MONITOR_H

#include <memory>
#include <mutex>
#include <string>

#include "ode_predictive_space/preload/ledger.h"
#include "ode_predictive_space/preload/output_file.h"
#include "ode_predictive_space/preload/settings.h"
#include "ode_predictive_space/preload/substitute.h"
#include "ode_predictive_space/recording/recorder.h"

namespace ode_predictive_space::preload
{
/// Measures, traces and records the collides of a process by its settings. Lives until the process ends.
class Monitor
{
public:
    Monitor(const Settings &settings, const OdeCalls &calls);

    void collide(dSpaceID space, void *data, dNearCallback *callback);
    void collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback);
    Ledger &ledger() { return ledger_; }

    /// Must be called before this process forks, and afterwards in the parent: no other thread records in between.
    void hold_recording() { recording_.lock(); }
    void resume_recording() { recording_.unlock(); }

    /// Must be called after a fork in the child, which begins another recording.
    void begin_recording_in_child();

    /// Ends the recording, and writes the statistics to where they are wanted.
    void finish();

private:
    struct Call;
    recording::Recorder *recorder();
    void end_recording();
    void write_statistics() const;
    template <typename Native, typename Record> void run(Call &call, Native native, Record record);
    void count(const Call &call);
    static void end_event(Call &call);
    void trace(Call &call);
    static void on_pair(void *call, dGeomID first, dGeomID second);

    Settings settings_;
    OdeCalls ode_;
    Ledger ledger_;
    std::unique_ptr<OutputFile> trace_file_; // 0: there is no trace
    std::mutex recording_;                   // guards the next three
    std::unique_ptr<recording::Recorder> recorder_;
    std::string recorded_file_;
    bool records_ = false; // a recording is wanted, and its file can be written
};
} // namespace ode_predictive_space::preload

#endif
