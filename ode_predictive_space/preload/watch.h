#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_WATCH_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_WATCH_H

#include <functional>
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
/// Measures, compares and traces the collides of a process, as the settings ask. Lives until the process ends.
class Watch
{
public:
    Watch(const Settings &settings, const OdeCalls &calls);

    void collide(dSpaceID space, void *data, dNearCallback *callback);
    void collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback);
    Ledger &ledger() { return ledger_; }

    /// Before this process forks, and afterwards in the parent: no other thread records meanwhile.
    void hold_recording() { recording_.lock(); }
    void resume_recording() { recording_.unlock(); }

    /// Afterwards in the child, which has a recording of its own.
    void begin_recording_in_child();

    /// Writes what has been learnt to where it is wanted.
    void report();

private:
    struct Call;
    recording::Recorder *recorder();
    void end_recording();
    void run(Call &call, void *data, dNearCallback *callback);
    static void end_event(Call &call);
    void judge(Call &call);
    void trace(Call &call);
    static void on_pair(void *call, dGeomID first, dGeomID second);

    Settings settings_;
    OdeCalls ode_;
    Ledger ledger_;
    std::unique_ptr<OutputFile> trace_file_;        // 0: there is no trace
    std::mutex recording_;                          // of the next three
    std::unique_ptr<recording::Recorder> recorder_; // 0: nothing has been recorded yet
    std::string recorded_file_;
    bool records_ = false; // unless it could not
    unsigned long complaints_ = 0;
};
} // namespace ode_predictive_space::preload

#endif
