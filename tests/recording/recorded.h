#ifndef ODE_PREDICTIVE_SPACE_TESTS_RECORDING_RECORDED_H
#define ODE_PREDICTIVE_SPACE_TESTS_RECORDING_RECORDED_H

#include <cstdint>
#include <memory>
#include <vector>

#include <ode/ode.h>

#include <gtest/gtest.h>

#include "ode_predictive_space/recording/recorder.h"
#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/space_kind.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::recording
{
class Recorded
{
public:
    explicit Recorded(std::uint64_t limit = 1 << 24)
        : recorder_(std::make_unique<Recorder>(HistoryFile(file_.path(), false), limit, "a test"))
    {}

    int collide(dSpaceID space, const EventTimes *times = nullptr)
    {
        Call call{recorder_->begin_collide(space), 0};
        dSpaceCollide(space, &call, note);
        call.event.end(times);
        return call.pairs;
    }

    int ask(dGeomID first, dGeomID second)
    {
        Call call{recorder_->begin_collide2(first, second), 0};
        dSpaceCollide2(first, second, &call, note);
        call.event.end();
        return call.pairs;
    }

    Recorder &recorder() { return *recorder_; }

    Recording end()
    {
        EXPECT_TRUE(recorder_->close());
        return Recording::read(file_.path());
    }

    /// The recording as it is after a crash.
    Recording so_far() const { return Recording::read(file_.path()); }

private:
    struct Call
    {
        Recorder::Event event;
        int pairs;
    };
    static void note(void *data, dGeomID first, dGeomID second)
    {
        Call &call = *static_cast<Call *>(data);
        call.event.note(first, second);
        ++call.pairs;
    }

    ScratchFile file_;
    std::unique_ptr<Recorder> recorder_;
};

/// Spaces of these kinds must find the pairs of simple spaces that the program got; collides that an exception ended have none.
void expect_pairs_agree(const Recording &recording,
                        const std::vector<SpaceKind> &kinds = {all_kinds.begin(), all_kinds.end()});
} // namespace ode_predictive_space::recording

#endif
