// dPredictiveSpaceRecord(), and listeners to notices. Recorded spaces get other virtual functions, so that others cost no more.

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <unordered_map>
#include <utility>
#include <vector>

#include <pthread.h>

#include "ode_predictive_space/history.h"
#include "ode_predictive_space/recording/notices.h"
#include "ode_predictive_space/recording/printable.h"
#include "ode_predictive_space/recording/recorder.h"
#include "ode_predictive_space/space/predictive_space.h"

namespace ode_predictive_space::recording
{
namespace
{
struct Recorded
{
    std::unique_ptr<Recorder> recorder; // made by dPredictiveSpaceRecord(); 0: none
    std::vector<NoticeListener *> listeners;
};

// Never destroyed: a program may end without destroying its spaces.
struct RecordedSpaces
{
    std::mutex mutex;
    std::unordered_map<dxPredictiveSpace *, Recorded> all;
};

RecordedSpaces &recorded_spaces();

// The lock is held during a fork, because the child has no other thread that could release it. The child has no listeners. A
// recording of dPredictiveSpaceRecord() continues in both processes, in one file.
void keep_usable_in_children()
{
    pthread_atfork([] { recorded_spaces().mutex.lock(); }, [] { recorded_spaces().mutex.unlock(); },
                   [] {
                       for (auto &each : recorded_spaces().all)
                           each.second.listeners.clear();
                       recorded_spaces().mutex.unlock();
                   });
}

RecordedSpaces &recorded_spaces()
{
    static auto *spaces = [] {
        keep_usable_in_children();
        return new RecordedSpaces;
    }();
    return *spaces;
}

void notify_listeners(dxPredictiveSpace *space, dGeomID geom)
{
    const std::lock_guard<std::mutex> guard(recorded_spaces().mutex);
    for (NoticeListener *listener : recorded_spaces().all.at(space).listeners)
        listener->notify_moved(geom);
}

Recorder *recorder_of(dxPredictiveSpace *space)
{
    const std::lock_guard<std::mutex> guard(recorded_spaces().mutex);
    return recorded_spaces().all.at(space).recorder.get();
}

struct Call
{
    Recorder::Event event;
    void *data;
    dNearCallback *callback;
};

void note_and_call_back(void *data, dGeomID first, dGeomID second)
{
    Call &call = *static_cast<Call *>(data);
    call.event.note(first, second);
    call.callback(call.data, first, second);
}

void forget(dxPredictiveSpace *space)
{
    Recorded recorded; // destroyed after the lock is released, because the recorder then stops listening
    const std::lock_guard<std::mutex> guard(recorded_spaces().mutex);
    const auto place = recorded_spaces().all.find(space);
    recorded = std::move(place->second);
    recorded_spaces().all.erase(place);
}

/// A predictive space becomes a RecordedSpace, and a dxPredictiveSpace again, by a change of its table of virtual functions.
class RecordedSpace final : public dxPredictiveSpace
{
public:
    using dxPredictiveSpace::dxPredictiveSpace;

    ~RecordedSpace() override { forget(this); }

    void dirty(dxGeom *geom) override
    {
        notify_listeners(this, geom);
        dxPredictiveSpace::dirty(geom);
    }

    void collide(void *data, dNearCallback *callback) override
    {
        Recorder *const recorder = recorder_of(this);
        if (!recorder)
            return dxPredictiveSpace::collide(data, callback);
        Call call{recorder->begin_collide(this), data, callback};
        dxPredictiveSpace::collide(&call, note_and_call_back);
        call.event.end();
    }

    // A call for a whole space is not recorded, because a replay would make one call for each of its geoms.
    void collide2(void *data, dxGeom *geom, dNearCallback *callback) override
    {
        Recorder *const recorder = recorder_of(this);
        if (!recorder || IS_SPACE(geom))
            return dxPredictiveSpace::collide2(data, geom, callback);
        Call call{recorder->begin_collide2(geom, this), data, callback};
        dxPredictiveSpace::collide2(&call, geom, note_and_call_back);
        call.event.end();
    }
};
static_assert(sizeof(RecordedSpace) == sizeof(dxPredictiveSpace), "it has no members of its own");

template <typename Space> void give_functions_of(dxPredictiveSpace *space)
{
    static const auto *prototype = new Space(nullptr); // never destroyed, because spaces use its functions
    std::memcpy(static_cast<void *>(space), static_cast<const void *>(prototype), sizeof(void *));
}

// @pre the caller holds the lock.
Recorded &entry_of(dxPredictiveSpace *space)
{
    const auto [place, is_new] = recorded_spaces().all.try_emplace(space);
    if (is_new)
        give_functions_of<RecordedSpace>(space);
    return place->second;
}

// @pre the caller holds the lock.
void leave_if_unused(dxPredictiveSpace *space)
{
    const auto place = recorded_spaces().all.find(space);
    if (place->second.recorder || !place->second.listeners.empty())
        return;
    recorded_spaces().all.erase(place);
    give_functions_of<dxPredictiveSpace>(space);
}

bool end_recording(dxPredictiveSpace *space)
{
    std::unique_ptr<Recorder> recorder;
    {
        const std::lock_guard<std::mutex> guard(recorded_spaces().mutex);
        const auto place = recorded_spaces().all.find(space);
        if (place == recorded_spaces().all.end() || !place->second.recorder)
            return true;
        recorder = std::move(place->second.recorder);
    }
    const bool was_written = recorder->close(); // it stops listening
    const std::lock_guard<std::mutex> guard(recorded_spaces().mutex);
    if (recorded_spaces().all.count(space))
        leave_if_unused(space);
    return was_written;
}

bool begin_recording(dxPredictiveSpace *space, const char *path, std::uint64_t limit)
try
{
    HistoryFile file(path, false);
    if (!file.is_open())
    {
        dMessage(d_ERR_UNKNOWN, "dPredictiveSpaceRecord(): nothing is recorded, as %s cannot be written: %s",
                 printable(path).c_str(),
                 file.error() == EBUSY ? "another recording is being written to it" : std::strerror(file.error()));
        return false;
    }
    auto recorder = std::make_unique<Recorder>(std::move(file), limit, note_of_process());
    const std::lock_guard<std::mutex> guard(recorded_spaces().mutex);
    entry_of(space).recorder = std::move(recorder);
    return true;
}
catch (const std::bad_alloc &)
{
    dMessage(d_ERR_UNKNOWN, "dPredictiveSpaceRecord(): nothing is recorded, as there is not enough memory");
    return false;
}
} // namespace
} // namespace ode_predictive_space::recording

void ode_predictive_space_listen(dSpaceID space, ode_predictive_space::recording::NoticeListener *listener)
{
    using namespace ode_predictive_space::recording;
    const std::lock_guard<std::mutex> guard(recorded_spaces().mutex);
    auto &listeners = entry_of(static_cast<dxPredictiveSpace *>(space)).listeners;
    if (std::find(listeners.begin(), listeners.end(), listener) == listeners.end())
        listeners.push_back(listener);
}

void ode_predictive_space_stop_listening(ode_predictive_space::recording::NoticeListener *listener)
{
    using namespace ode_predictive_space::recording;
    const std::lock_guard<std::mutex> guard(recorded_spaces().mutex);
    std::vector<dxPredictiveSpace *> spaces;
    for (auto &[space, recorded] : recorded_spaces().all)
    {
        auto &listeners = recorded.listeners;
        listeners.erase(std::remove(listeners.begin(), listeners.end(), listener), listeners.end());
        spaces.push_back(space);
    }
    for (dxPredictiveSpace *space : spaces)
        leave_if_unused(space);
}

int dPredictiveSpaceRecord(dSpaceID space, const char *path, unsigned long limit)
{
    using namespace ode_predictive_space::recording;
    constexpr unsigned long default_limit = 256ul << 20;
    if (!dSpaceIsPredictive(space))
    {
        dMessage(d_ERR_UASSERT, "%s(): bad argument space: it is %s", __func__,
                 space ? "not a predictive space" : "null");
        return 0;
    }
    auto *self = static_cast<dxPredictiveSpace *>(space);
    CHECK_NOT_LOCKED(self);
    const bool was_written = end_recording(self);
    if (!was_written)
        dMessage(d_ERR_UNKNOWN, "%s(): the recording could not be written to its end; what was written can be replayed",
                 __func__);
    return path ? begin_recording(self, path, limit ? limit : default_limit) : was_written;
}
