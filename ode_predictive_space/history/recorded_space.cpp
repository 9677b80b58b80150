// dPredictiveSpaceRecord(): a space that is recorded has other virtual functions than one that is not, which costs nothing.

#include <cerrno>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <unordered_map>

#include "ode_predictive_space/history.h"
#include "ode_predictive_space/history/recorder.h"
#include "ode_predictive_space/process/printable.h"
#include "ode_predictive_space/space/predictive_space.h"

namespace ode_predictive_space::history
{
namespace
{
class RecordedSpace;

// Of the spaces that are recorded. Never destroyed: a program may end with its spaces.
struct Recorders
{
    std::mutex mutex;
    std::unordered_map<const dxSpace *, std::unique_ptr<Recorder>> of;
};

Recorders &recorders()
{
    static auto *all = new Recorders;
    return *all;
}

Recorder &recorder_of(const dxSpace *space)
{
    const std::lock_guard<std::mutex> guard(recorders().mutex);
    return *recorders().of.at(space);
}

// What a collide is recorded with, and the callback of the program.
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

bool end_recording(const dxSpace *space)
{
    std::unique_ptr<Recorder> recorder;
    {
        const std::lock_guard<std::mutex> guard(recorders().mutex);
        const auto place = recorders().of.find(space);
        if (place == recorders().of.end())
            return true;
        recorder = std::move(place->second);
        recorders().of.erase(place);
    }
    return recorder->close();
}

/// A predictive space is made one of this class, and made what it was again, by its table of virtual functions alone.
class RecordedSpace final : public dxPredictiveSpace
{
public:
    using dxPredictiveSpace::dxPredictiveSpace;

    ~RecordedSpace() override { end_recording(this); }

    void collide(void *data, dNearCallback *callback) override
    {
        Call call{recorder_of(this).begin_collide(this), data, callback};
        dxPredictiveSpace::collide(&call, note_and_call_back);
        call.event.end();
    }

    // When two spaces are asked about each other, ODE calls this for each geom of one of them. A call for a space is not recorded: a
    // replay would ask about its geoms one by one.
    void collide2(void *data, dxGeom *geom, dNearCallback *callback) override
    {
        if (IS_SPACE(geom))
            return dxPredictiveSpace::collide2(data, geom, callback);
        Call call{recorder_of(this).begin_collide2(geom, this), data, callback};
        dxPredictiveSpace::collide2(&call, geom, note_and_call_back);
        call.event.end();
    }
};
static_assert(sizeof(RecordedSpace) == sizeof(dxPredictiveSpace), "it has no members of its own");

template <typename Space> void give_functions_of(dxPredictiveSpace *space)
{
    static const auto *prototype = new Space(nullptr); // never destroyed: there are spaces that have its functions
    std::memcpy(static_cast<void *>(space), static_cast<const void *>(prototype), sizeof(void *));
}

bool begin_recording(dxPredictiveSpace *space, const char *path, std::uint64_t limit)
try
{
    HistoryFile file(path, false);
    if (!file.is_open())
    {
        dMessage(d_ERR_UNKNOWN, "dPredictiveSpaceRecord(): %s cannot be written: %s", printable(path).c_str(),
                 file.error() == EBUSY ? "another recording is being written to it" : std::strerror(file.error()));
        return false;
    }
    auto recorder = std::make_unique<Recorder>(std::move(file), limit, note_of_process());
    {
        const std::lock_guard<std::mutex> guard(recorders().mutex);
        recorders().of[space] = std::move(recorder);
    }
    give_functions_of<RecordedSpace>(space);
    return true;
}
catch (const std::bad_alloc &)
{
    dMessage(d_ERR_UNKNOWN, "dPredictiveSpaceRecord(): there is no memory for a recording");
    return false;
}
} // namespace
} // namespace ode_predictive_space::history

int dPredictiveSpaceRecord(dSpaceID space, const char *path, unsigned long limit)
{
    using namespace ode_predictive_space::history;
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
    give_functions_of<dxPredictiveSpace>(self);
    if (!was_written)
        dMessage(d_ERR_UNKNOWN, "%s(): the recording could not be written to its end", __func__);
    return path ? begin_recording(self, path, limit ? limit : default_limit) : was_written;
}
