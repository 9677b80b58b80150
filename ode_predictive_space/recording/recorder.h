// Before each collide, all geoms are read and their changes recorded; notices of predictive spaces are counted.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_RECORDER_H
#define ODE_PREDICTIVE_SPACE_RECORDING_RECORDER_H

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include <ode/common.h>

#include "ode_predictive_space/recording/format.h"
#include "ode_predictive_space/recording/history_file.h"
#include "ode_predictive_space/recording/notices.h"
#include "ode_predictive_space/recording/shape_data.h"
#include "ode_predictive_space/recording/state.h"

namespace ode_predictive_space::recording
{
/// Calls from several threads are safe; changes that another thread makes meanwhile may be recorded in part. When memory runs
/// out, the recording ends after its last whole record, and the program continues.
class Recorder
{
public:
    /// @param file an empty one, taken over. @param limit of bytes; the recording ends before a collide that would exceed it.
    /// @param note names the program. @param is_substitute whether a predictive space replaces a space of ODE in the program.
    Recorder(
        HistoryFile file, std::uint64_t limit, const std::string &note,
        std::function<bool(dSpaceID)> is_substitute = [](dSpaceID) { return false; });
    ~Recorder();
    Recorder(const Recorder &) = delete;
    Recorder &operator=(const Recorder &) = delete;

    /// A dSpaceCollide() or dSpaceCollide2(), from before its first callback to after its last one.
    class Event
    {
    public:
        /// Must be called for each callback.
        void note(dGeomID first, dGeomID second);

        /// Must be called after the last callback. @param times in the program; 0 if unknown.
        void end(const EventTimes *times = nullptr);

    private:
        friend class Recorder;
        Event(Recorder *recorder, std::uint32_t number) : recorder_(recorder), number_(number) {}
        Recorder *recorder_; // 0: not recorded
        std::uint32_t number_;
        std::uint32_t pairs_ = 0;
        std::uint64_t hash_ = 0;
    };

    /// Must be called before dSpaceCollide(space), and begin_collide2() before dSpaceCollide2(first, second).
    Event begin_collide(dSpaceID space);

    Event begin_collide2(dGeomID first, dGeomID second);

    /// Whether nothing more is written: it is closed, the limit is reached, the file cannot be written, or memory has run out.
    bool is_over() const { return over_; }

    /// Ends the recording. @return whether all of it is in the file.
    bool close();

    /// Ends the recording in a forked process; the file remains the parent's.
    void leave_to_parent();

private:
    struct Known
    {
        std::uint32_t id;
        std::uint64_t seen; // in this walk
        GeomState state;
    };
    struct KnownBody
    {
        std::uint32_t id;
        std::uint64_t seen;
        bool changed; // in the present walk
        BodyState state;
    };

    class Record;
    template <typename Make> bool append(Make make);
    template <typename Make> Event begin_event(Make make);
    void cut();
    void inspect(dGeomID geom, bool is_collide);
    bool is_known(dGeomID geom) const;
    void visit(dGeomID geom, bool is_collide);
    void visit_members(dSpaceID space, bool is_collide);
    std::uint32_t body_of(dGeomID geom, bool &changed);
    void take_shape_data(dGeomID geom, bool is_collide, GeomState &state);
    void write_geom(const Known &known, std::uint16_t fields);
    void write_body(const KnownBody &known, std::uint16_t fields);
    SpaceService service_of(dSpaceID space);
    void take_notices(dGeomID geom, const Known &known, std::uint16_t fields, bool body_changed);
    void write_notices();
    void forget_absent();
    void count_member(std::uint32_t parent, int change);
    Event write_event(std::size_t before);

    std::mutex mutex_;
    HistoryFile file_;
    std::uint64_t limit_;
    std::string buffer_;         // whole records, not written yet
    std::size_t unfinished_ = 0; // events whose pairs are not in the buffer yet; the limit has room for them
    std::atomic<bool> over_{false};

    ShapeData shape_data_;
    std::unordered_map<dGeomID, Known> geoms_;
    std::unordered_map<dBodyID, KnownBody> bodies_;
    std::unordered_map<std::uint32_t, std::size_t> member_counts_; // by GeomState::parent
    bool has_absent_ = false;           // the present walk has found a space with fewer geoms than are known in it
    std::vector<std::uint32_t> walked_; // ids of the spaces whose geoms have been visited
    std::uint32_t next_geom_ = 0, next_body_ = 0, next_event_ = 0;
    std::uint64_t walk_ = 0;
    std::function<bool(dSpaceID)> is_substitute_;
    NoticeCounts notices_;
    std::vector<std::array<std::uint32_t, 2>> noticed_; // ids and numbers of the present walk
};

/// "ode_predictive_space recorded <program>", and ODE's configuration.
std::string note_of_process();
} // namespace ode_predictive_space::recording

#endif
