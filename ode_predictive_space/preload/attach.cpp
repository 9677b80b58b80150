// The half that is loaded into a process when it first calls ODE.

#include <cstdlib>
#include <string>
#include <vector>

#include <pthread.h>

#include "ode_predictive_space/ode/check.h"
#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/predictive_space.h"
#include "ode_predictive_space/preload/monitor.h"
#include "ode_predictive_space/preload/say.h"
#include "ode_predictive_space/preload/settings.h"
#include "ode_predictive_space/preload/substitute.h"
#include "ode_predictive_space/recording/notices.h"

namespace ode_predictive_space::preload
{
namespace
{
// Never deleted: a program may make spaces and collide until the process ends.
const Settings *settings;
Monitor *monitor;

// The space has the class that the program asked for.
dSpaceID create(int space_class, dSpaceID parent)
{
    if (settings->replaced.count(space_class) == 0)
        return nullptr;
    dSpaceID space = dPredictiveSpaceCreate(parent);
    if (!space)
        return nullptr;
    space->type = space_class;
    if (settings->proximity != dPredictiveProximityBox)
        dPredictiveSpaceSetProximity(space, settings->proximity);
    if (monitor)
        monitor->ledger().made(space, true);
    return space;
}

void made(dSpaceID space)
{
    monitor->ledger().made(space, false);
}

void collide(dSpaceID space, void *data, dNearCallback *callback)
{
    monitor->collide(space, data, callback);
}

void collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback)
{
    monitor->collide2(first, second, data, callback);
}

void keep_ledger_whole_in_children()
{
    // Registers the library's own handlers first, so that its lock is taken after those below, as at the end of a recording.
    ode_predictive_space_stop_listening(nullptr);
    pthread_atfork(
        [] {
            monitor->hold_recording();
            monitor->ledger().lock();
        },
        [] {
            monitor->ledger().unlock();
            monitor->resume_recording();
        },
        [] {
            monitor->ledger().begin_in_child();
            monitor->begin_recording_in_child();
        });
}

// Both checks of ODE, this library's and the plugin's, list the objects of the process, which takes the lock of the dynamic linker.
// During loading this thread has that lock. A later check under a lock of ours could wait for a thread that has the linker's lock
// and waits for ours.
__attribute__((constructor)) void check_ode()
{
    if (!ode_mismatch())
        dSpaceDestroy(dPredictiveSpaceCreate(nullptr));
}

__attribute__((destructor)) void finish()
{
    if (monitor)
        monitor->finish();
}
} // namespace

extern "C" __attribute__((visibility("default"))) const Hooks *ode_predictive_space_attach(const OdeCalls *calls)
{
    if (const char *mismatch = ode_mismatch())
    {
        say("the ODE of this program cannot be used: %s; the program keeps its own spaces", mismatch);
        return nullptr;
    }
    std::vector<std::string> complaints;
    settings = new Settings(read_settings([](const char *name) { return secure_getenv(name); }, complaints));
    for (const std::string &complaint : complaints)
        say("%s", complaint.c_str());
    static Hooks hooks{create, nullptr, nullptr, nullptr};
    if (settings->monitors())
    {
        monitor = new Monitor(*settings, *calls);
        keep_ledger_whole_in_children();
        hooks = {create, made, collide, collide2};
    }
    return &hooks;
}
} // namespace ode_predictive_space::preload
