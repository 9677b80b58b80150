// Any bytes as a recorded history: the reader accepts them, or refuses them and names a byte. An accepted history is replayed,
// and if a program could have recorded it, a predictive space finds the pairs of a simple one.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <ode/ode.h>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/stage.h"
#include "tests/fuzz/fuzz_target.h"

namespace ode_predictive_space
{
namespace
{
using namespace recording;

void expect(bool holds, const char *what)
{
    if (holds)
        return;
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

[[noreturn]] void end(int /*number*/, const char *format, va_list arguments)
{
    std::vfprintf(stderr, format, arguments);
    std::fputs("\n", stderr);
    std::abort();
}

bool start_ode()
{
    dInitODE2(0);
    dSetDebugHandler(end);
    dSetErrorHandler(end);
    return true;
}

bool is_small(const Recording &recording)
{
    return recording.events().size() <= 50 && recording.geom_count() <= 100;
}

// Small enough for all sums and products to be finite.
bool is_usual(const dReal *values, std::size_t count)
{
    return std::all_of(values, values + count, [](dReal value) { return std::abs(value) < 1e6; });
}

bool is_rotation(const Pose &pose)
{
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
        {
            double product = 0;
            for (std::size_t k = 0; k < 3; ++k)
                product += pose[3 + 3 * i + k] * pose[3 + 3 * j + k];
            if (!(std::abs(product - (i == j)) < 1e-5))
                return false;
        }
    return true;
}

bool is_usual(const Pose &pose)
{
    return is_usual(pose.data(), pose.size()) && is_rotation(pose);
}

bool is_usual(const GeomChange &change)
{
    const GeomState &state = change.state;
    if (!is_usual(state.size.data(), state.size.size()))
        return false;
    if (state.geom_class == stand_in && (change.fields & geom_field::size))
        for (std::size_t axis = 0; axis < 6; axis += 2)
            if (state.size[axis] > state.size[axis + 1])
                return false;
    if ((change.fields & geom_field::offset) && state.has_offset && !is_usual(state.offset))
        return false;
    return !(change.fields & geom_field::pose) || !has_own_pose(state) || is_usual(state.pose);
}

bool is_usual(const Recording &recording)
{
    for (const Record &record : recording.records())
    {
        if (record.kind == RecordKind::convex || record.kind == RecordKind::mesh)
            return false;
        if (record.kind == RecordKind::geom && !is_usual(recording.geom(record)))
            return false;
        if (record.kind != RecordKind::body)
            continue;
        const BodyChange change = recording.body(record);
        if (((change.fields & body_field::pose) && !is_usual(change.state.pose)) ||
            !is_usual(change.state.velocity.data(), change.state.velocity.size()))
            return false;
    }
    return true;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

void add(void *pairs, dGeomID first, dGeomID second)
{
    static_cast<Pairs *>(pairs)->push_back(
        std::minmax(recording::Stage::id_of(first), recording::Stage::id_of(second)));
}

Pairs pairs_of(recording::Stage &stage, const Record &record)
{
    Pairs pairs;
    stage.ask(record, &pairs, add);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

void replay_all(const Recording &recording)
{
    const bool usual = is_usual(recording);
    recording::Stage simple(recording, recording::SpaceKind::simple), box(recording, recording::SpaceKind::box),
        shape(recording, recording::SpaceKind::shape);
    for (const Record &record : recording.records())
        if (record.kind == RecordKind::collide || record.kind == RecordKind::collide2)
        {
            const Pairs expected = pairs_of(simple, record), found = pairs_of(box, record);
            expect(!usual || found == expected, "a predictive space has other pairs than a simple one");
            pairs_of(shape, record);
        }
        else
            for (recording::Stage *stage : {&simple, &box, &shape})
                stage->apply(record);
}
void take(const std::uint8_t *data, std::size_t size)
{
    static const bool started = start_ode();
    static_cast<void>(started);
    try
    {
        const Recording recording(std::vector<char>(data, data + size));
        if (is_small(recording))
            replay_all(recording);
    }
    catch (const BadRecording &error)
    {
        expect(error.offset <= size, "a byte is named that the file does not have");
    }
}
} // namespace
} // namespace ode_predictive_space

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    ode_predictive_space::take(data, size);
    return 0;
}
