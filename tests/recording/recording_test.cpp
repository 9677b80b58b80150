// Broken and hostile files: the reader names the offset of the wrong record.

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include <ode/ode.h>

#include "ode_predictive_space/recording/recording.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::recording
{
namespace
{
class Bytes
{
public:
    explicit Bytes(std::uint32_t version = format_version) : version_(version)
    {
        raw(magic, sizeof magic);
        number<std::uint32_t>(version).number<std::uint32_t>(sizeof(dReal));
    }

    template <typename Number, typename Value> Bytes &number(Value value)
    {
        const auto exact = static_cast<Number>(value);
        raw(&exact, sizeof exact);
        return *this;
    }

    Bytes &reals(int count, dReal value = 1)
    {
        for (int i = 0; i < count; ++i)
            raw(&value, sizeof value);
        return *this;
    }

    Bytes &begin(RecordKind kind)
    {
        begin_ = bytes_.size();
        return number<std::uint32_t>(0).number<std::uint8_t>(kind);
    }

    Bytes &end()
    {
        const auto size = static_cast<std::uint32_t>(bytes_.size() - begin_ - record_header_size);
        std::memcpy(&bytes_[begin_], &size, sizeof size);
        return *this;
    }

    struct Links
    {
        std::uint32_t parent = 0, data = 0, body = 0;
        bool has_offset = false;
        std::int32_t min_level = 0, max_level = 0;
        std::uint8_t predictive = 0, is_substitute = 0;
    };

    Bytes &geom(std::uint32_t id, int geom_class, const Links &links, dReal size = 1)
    {
        begin(RecordKind::geom).number<std::uint32_t>(id).number<std::uint8_t>(geom_class);
        number<std::uint16_t>(version_ == 1 ? geom_field::all_of_version_1 : geom_field::all);
        number<std::uint32_t>(0).number<std::int32_t>(links.min_level);
        number<std::int32_t>(links.max_level).number<std::uint32_t>(links.parent);
        number<std::uint64_t>(1).number<std::uint64_t>(1);
        number<std::uint8_t>(geom_enabled).reals(size_count(geom_class), size).number<std::uint32_t>(links.data);
        number<std::uint32_t>(links.body).number<std::uint8_t>(links.has_offset).reals(12).reals(12);
        if (version_ > 1)
            number<std::uint8_t>(links.predictive).number<std::uint8_t>(links.is_substitute);
        return end();
    }

    Bytes &geom(std::uint32_t id, int geom_class, std::uint32_t parent = 0, std::uint32_t data = 0, dReal size = 1)
    {
        Links links;
        links.parent = parent;
        links.data = data;
        return geom(id, geom_class, links, size);
    }

    Bytes &geom_on_body(std::uint32_t id, int geom_class, std::uint32_t body, bool has_offset = false)
    {
        Links links;
        links.body = body;
        links.has_offset = has_offset;
        return geom(id, geom_class, links);
    }

    Bytes &hash_space(std::uint32_t id, std::int32_t min_level, std::int32_t max_level)
    {
        Links links;
        links.min_level = min_level;
        links.max_level = max_level;
        return geom(id, dHashSpaceClass, links);
    }

    Bytes &predictive_space(std::uint32_t id, int predictive, int is_substitute = 0)
    {
        Links links;
        links.predictive = static_cast<std::uint8_t>(predictive);
        links.is_substitute = static_cast<std::uint8_t>(is_substitute);
        return geom(id, dHashSpaceClass, links);
    }

    Bytes &heights(std::uint32_t columns, std::uint32_t rows, dReal width = 2, double sample = 0, dReal lowest = -1,
                   dReal highest = 1, dReal depth = 2)
    {
        begin(RecordKind::heights).number<std::uint32_t>(0).number<std::uint32_t>(columns).number<std::uint32_t>(rows);
        number<std::uint8_t>(1).reals(1, width).reals(1, depth).reals(3).reals(1, lowest).reals(1, highest);
        for (int i = 0; i < 4; ++i)
            number<double>(sample);
        return end();
    }

    Bytes &change(std::uint32_t id, int geom_class, std::uint16_t field, std::uint32_t value)
    {
        begin(RecordKind::geom).number<std::uint32_t>(id).number<std::uint8_t>(geom_class);
        return number<std::uint16_t>(field).number<std::uint32_t>(value).end();
    }

    Bytes &body(std::uint32_t id)
    {
        begin(RecordKind::body).number<std::uint32_t>(id).number<std::uint16_t>(body_field::all);
        return number<std::uint8_t>(body_enabled).reals(12).reals(6).end();
    }

    Bytes &pairs(std::uint32_t event)
    {
        begin(RecordKind::pairs).number<std::uint32_t>(event).number<std::uint32_t>(1);
        return number<std::uint64_t>(1).end();
    }

    Bytes &times(std::uint32_t event, float seconds)
    {
        begin(RecordKind::times).number<std::uint32_t>(event);
        return number<float>(seconds).number<float>(seconds).number<float>(seconds).end();
    }

    Bytes &event(RecordKind kind, std::initializer_list<std::uint32_t> ids)
    {
        begin(kind);
        for (const std::uint32_t id : ids)
            number<std::uint32_t>(id);
        return end();
    }

    Bytes &mesh(std::uint32_t triangles, std::uint32_t corner, float coordinate = 0)
    {
        begin(RecordKind::mesh).number<std::uint32_t>(0).number<std::uint8_t>(1);
        number<std::uint32_t>(3).number<std::uint32_t>(triangles);
        for (int i = 0; i < 9; ++i)
            number<float>(coordinate);
        for (std::uint32_t i = 0; i < 3 * triangles; ++i)
            number<std::uint32_t>(corner);
        return end();
    }

    Bytes &convex(std::uint32_t corners, std::uint32_t corner)
    {
        begin(RecordKind::convex).number<std::uint32_t>(0).number<std::uint32_t>(1).number<std::uint32_t>(3);
        number<std::uint32_t>(4).reals(4).reals(9).number<std::uint32_t>(corners);
        for (int i = 0; i < 3; ++i)
            number<std::uint32_t>(corner);
        return end();
    }

    // This record and the next are longer than records of most other kinds can be.
    Bytes &many_notices()
    {
        begin(RecordKind::notices);
        for (int i = 0; i < 200; ++i)
            number<std::uint32_t>(0).number<std::uint32_t>(2);
        return end();
    }

    Bytes &large_convex()
    {
        constexpr std::uint32_t points = 60;
        begin(RecordKind::convex).number<std::uint32_t>(1).number<std::uint32_t>(1).number<std::uint32_t>(points);
        number<std::uint32_t>(points + 1).reals(4).reals(3 * points).number<std::uint32_t>(points);
        for (std::uint32_t i = 0; i < points; ++i)
            number<std::uint32_t>(i);
        return end();
    }

    std::size_t size() const { return bytes_.size(); }
    std::vector<char> &bytes() { return bytes_; }

private:
    void raw(const void *bytes, std::size_t size)
    {
        const auto *begin = static_cast<const char *>(bytes);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }

    std::vector<char> bytes_;
    std::size_t begin_ = 0;
    std::uint32_t version_;
};

// The reader's complaint, which must be about this offset, or an empty text.
std::string complaint(Bytes bytes, std::size_t offset)
{
    try
    {
        Recording recording(bytes.bytes());
        return "";
    }
    catch (const BadRecording &error)
    {
        EXPECT_EQ(error.offset, offset) << error.what();
        return error.what();
    }
}

// What follows on these bytes must be refused.
struct Refusals
{
    const Bytes &good;

    void operator()(const std::string &what, const std::function<void(Bytes &)> &go_on) const
    {
        Bytes bytes = good;
        go_on(bytes);
        EXPECT_NE(complaint(bytes, good.size()).find(what), std::string::npos)
            << what << ": " << complaint(bytes, good.size());
    }
};

TEST(Recording, TakesWhatIsWhole)
{
    Bytes bytes;
    bytes.geom(0, dHashSpaceClass).geom(1, dSphereClass, 1).mesh(1, 2).geom(2, dTriMeshClass, 1, 0);
    bytes.event(RecordKind::collide, {0}).event(RecordKind::collide2, {1, 0}).event(RecordKind::gone, {1});
    EXPECT_EQ(complaint(bytes, 0), "");
    const Recording recording(bytes.bytes());
    EXPECT_EQ(recording.events().size(), 2u);
    EXPECT_EQ(recording.geom_count(), 3u);
    bytes.body(0).geom_on_body(3, dBoxClass, 1, true).geom_on_body(4, dBoxClass, 1).hash_space(5, -7, 5).pairs(0);
    EXPECT_EQ(complaint(bytes, 0), "");
}

TEST(Recording, TakesHeightsNoticesAndPredictiveSpaces)
{
    Bytes bytes;
    bytes.predictive_space(0, 3).heights(2, 2).geom(1, dHeightfieldClass, 1).geom(2, fixed_heightfield, 1);
    bytes.event(RecordKind::notices, {2, 7, 0, 1}).event(RecordKind::collide, {0});
    EXPECT_EQ(complaint(bytes, 0), "");
    const Recording recording(bytes.bytes());
    const std::vector<NoticeCount> notices = recording.notices(recording.records()[4]);
    ASSERT_EQ(notices.size(), 2u);
    EXPECT_EQ(notices[0].id, 2u);
    EXPECT_EQ(notices[0].number, 7u);
    EXPECT_EQ(recording.stand_ins(), 0u);
}

TEST(Recording, TakesAFileOfTheFirstVersion)
{
    Bytes bytes(1);
    bytes.geom(0, dHashSpaceClass).geom(1, dSphereClass, 1).event(RecordKind::collide, {0});
    EXPECT_EQ(complaint(bytes, 0), "");
    EXPECT_EQ(Recording(bytes.bytes()).version(), 1u);
    Refusals{bytes}("too long for its content", [](Bytes &b) { b.change(0, dHashSpaceClass, geom_field::service, 0); });
    bytes.heights(2, 2);
    Refusals{bytes}("version 1", [](Bytes &b) { b.geom(2, dHeightfieldClass, 1); });
}

// The launcher's advice is about this space.
TEST(Recording, KnowsItsFirstSpace)
{
    Bytes bytes;
    bytes.body(0).body(1).geom(0, dHashSpaceClass).geom(1, dSimpleSpaceClass).geom(2, dSphereClass, 1);
    EXPECT_EQ(Recording(bytes.bytes()).first_space(), 0u) << "nothing is asked";
    bytes.event(RecordKind::collide2, {2, 1}).event(RecordKind::collide2, {2, 0});
    EXPECT_EQ(Recording(bytes.bytes()).first_space(), 1u) << "the first that is asked";
    EXPECT_EQ(Recording(bytes.bytes()).state_of_first_space().geom_class, dSimpleSpaceClass);
    Bytes collided = bytes;
    collided.event(RecordKind::collide, {0}).event(RecordKind::collide, {1}).event(RecordKind::collide2, {2, 1});
    EXPECT_EQ(Recording(collided.bytes()).first_space(), 0u) << "the first that is collided";
}

TEST(Recording, RefusesOtherFiles)
{
    EXPECT_THROW(Recording(std::vector<char>(3, 'x')), BadRecording);
    EXPECT_THROW(Recording(std::vector<char>(1000, 'x')), BadRecording);
    EXPECT_THROW(Recording::read("/nonexistent/file"), std::runtime_error);
    EXPECT_THROW(Recording::read(testing::TempDir()), std::runtime_error) << "a folder";
    for (const char version : {3, 0}) // neither version is known
    {
        Bytes other;
        other.bytes()[sizeof magic] = version;
        EXPECT_NE(complaint(other, 8).find("has version " + std::to_string(version)), std::string::npos);
    }
    Bytes precision;
    precision.bytes()[sizeof magic + 4] = sizeof(dReal) == 8 ? 4 : 8;
    EXPECT_NE(complaint(precision, 12).find("precision"), std::string::npos);
}

// Once, such a file, left by a program that was killed while it wrote, was refused as a whole.
TEST(Recording, IsReadUpToItsLastWholeRecordWhereverItIsCut)
{
    Bytes bytes;
    std::vector<std::size_t> ends = {bytes.size()};
    const auto add = [&](const Bytes &) { ends.push_back(bytes.size()); };
    add(bytes.geom(0, dHashSpaceClass));
    add(bytes.mesh(100, 2));
    add(bytes.large_convex());
    add(bytes.many_notices());
    add(bytes.geom(1, dSphereClass, 1));
    add(bytes.event(RecordKind::collide, {0}));
    add(bytes.pairs(0));
    add(bytes.begin(RecordKind::end).number<std::uint8_t>(0).end());
    for (std::size_t size = 0; size <= bytes.size(); ++size)
    {
        SCOPED_TRACE(size);
        const Recording recording(
            std::vector<char>(bytes.bytes().begin(), bytes.bytes().begin() + std::ptrdiff_t(size)));
        const auto whole = std::upper_bound(ends.begin(), ends.end(), size) - ends.begin() - 1;
        EXPECT_EQ(recording.records().size(), std::size_t(std::max(whole, std::ptrdiff_t{0})));
        EXPECT_EQ(recording.whole_bytes(), whole < 0 ? size : ends[std::size_t(whole)]);
        EXPECT_EQ(recording.events().size(), std::size_t(whole >= 6));
        EXPECT_EQ(recording.has_end(), size == bytes.size());
    }
}

// A length that no record of its kind has is a fault of the file, not a cut.
TEST(Recording, RefusesALengthThatNoRecordOfItsKindHas)
{
    Bytes good;
    good.geom(0, dHashSpaceClass);
    const Refusals refused{good};
    const char *const what = "longer than any of its kind";
    refused(what, [](Bytes &b) { b.number<std::uint32_t>(0x7fffffff).number<std::uint8_t>(RecordKind::collide); });
    refused(what, [](Bytes &b) { b.number<std::uint32_t>(4).number<std::uint8_t>(77); });
}

TEST(Recording, RefusesWhatAReplayWouldStumbleOver)
{
    Bytes good;
    good.geom(0, dHashSpaceClass).geom(1, dSphereClass, 1);
    const Refusals refused{good};
    refused("not the next one", [](Bytes &b) { b.geom(3, dSphereClass); });
    refused("negative or not a number", [](Bytes &b) { b.geom(2, dBoxClass, 0, 0, -1); });
    refused("negative or not a number",
            [](Bytes &b) { b.geom(2, dSphereClass, 0, 0, std::numeric_limits<dReal>::quiet_NaN()); });
    refused("class of a geom is unknown", [](Bytes &b) { b.geom(2, dFirstUserClass); });
    refused("never recorded", [](Bytes &b) { b.geom(2, dGeomTransformClass); });
    refused("data of a mesh, convex or heightfield do not exist", [](Bytes &b) { b.geom(2, dHeightfieldClass); });
    refused("data of a mesh, convex or heightfield do not exist", [](Bytes &b) { b.geom(2, fixed_heightfield); });
    refused("too few or too many", [](Bytes &b) { b.heights(1, 4); });
    refused("too few or too many", [](Bytes &b) { b.heights(0x10000, 0x10000); });
    refused("too short for its content", [](Bytes &b) { b.heights(3, 2); });
    refused("no width", [](Bytes &b) { b.heights(2, 2, 0); });
    refused("not finite", [](Bytes &b) { b.heights(2, 2, std::numeric_limits<dReal>::infinity()); });
    refused("sample is not finite", [](Bytes &b) { b.heights(2, 2, 2, std::numeric_limits<double>::quiet_NaN()); });
    refused("no depth", [](Bytes &b) { b.heights(2, 2, 2, 0, -1, 1, 0); });
    refused("not finite", [](Bytes &b) { b.heights(2, 2, 2, 0, -1, 1, std::numeric_limits<dReal>::infinity()); });
    refused("not a number", [](Bytes &b) { b.heights(2, 2, 2, 0, std::numeric_limits<dReal>::quiet_NaN()); });
    refused("not a number", [](Bytes &b) { b.heights(2, 2, 2, 0, -1, std::numeric_limits<dReal>::quiet_NaN()); });
    refused("kind of a predictive space is unknown", [](Bytes &b) { b.predictive_space(2, 4); });
    refused("kind of a predictive space is unknown", [](Bytes &b) { b.predictive_space(2, 1, 2); });
    refused("kind of a predictive space is unknown", [](Bytes &b) { b.predictive_space(2, 0, 1); });
    refused("does not exist", [](Bytes &b) { b.event(RecordKind::notices, {2, 1}); });
    refused("too many notices", [](Bytes &b) { b.event(RecordKind::notices, {1, most_notices + 1}); });
    refused("too long for its content", [](Bytes &b) { b.event(RecordKind::notices, {1}); });
    refused("a geom that is not a space", [](Bytes &b) { b.geom(2, dSphereClass, 2); });
    refused("a geom that is not a space", [](Bytes &b) { b.geom(2, dSphereClass, 77); });
    refused("a geom that is not a space", [](Bytes &b) { b.geom(2, dSimpleSpaceClass, 3); }); // in itself
    refused("data of a mesh, convex or heightfield do not exist", [](Bytes &b) { b.geom(2, dTriMeshClass, 1, 0); });
    refused("a geom does not exist", [](Bytes &b) { b.event(RecordKind::collide, {5}); });
    refused("queried is not a space", [](Bytes &b) { b.event(RecordKind::collide, {1}); });
    refused("queried is not a space", [](Bytes &b) { b.event(RecordKind::collide2, {1, 1}); });
    refused("too short for its content", [](Bytes &b) { b.event(RecordKind::collide2, {1}); });
    refused("too long for its content", [](Bytes &b) { b.event(RecordKind::collide, {0, 0}); });
    refused("event of these pairs does not exist", [](Bytes &b) { b.event(RecordKind::pairs, {0, 0, 0, 0}); });
    refused("kind of the record is unknown", [](Bytes &b) { b.event(static_cast<RecordKind>(77), {0}); });
    refused("no triangle", [](Bytes &b) { b.mesh(0, 0); });
    refused("not a vertex", [](Bytes &b) { b.mesh(1, 3); });
    refused("not finite", [](Bytes &b) { b.mesh(1, 0, std::numeric_limits<float>::infinity()); });
    refused("too short for its content", [](Bytes &b) { b.event(RecordKind::mesh, {0, 0xffffff00, 0xffffffff, 0}); });
    refused("corners", [](Bytes &b) { b.convex(2, 0); });
    refused("corners", [](Bytes &b) { b.convex(0xffffffff, 0); });
    refused("not a point", [](Bytes &b) { b.convex(3, 3); });
    refused("not described", [](Bytes &b) {
        b.begin(RecordKind::body).number<std::uint32_t>(0).number<std::uint16_t>(1).number<std::uint8_t>(1).end();
    });
}

TEST(Recording, RefusesLinksThatOdeWouldStopAt)
{
    Bytes good;
    good.geom(0, dHashSpaceClass).geom(1, dSphereClass, 1).body(0).event(RecordKind::collide, {0}).pairs(0).times(0, 1);
    good.event(RecordKind::collide, {0});
    const Refusals refused{good};
    refused("a body does not exist", [](Bytes &b) { b.geom_on_body(2, dSphereClass, 2); });
    refused("a body does not exist", [](Bytes &b) { b.geom_on_body(2, dPlaneClass, 1); });
    refused("a body does not exist", [](Bytes &b) { b.geom_on_body(2, dSimpleSpaceClass, 1); });
    refused("not the next one", [](Bytes &b) { b.body(2); });
    refused("without a body", [](Bytes &b) { b.geom_on_body(2, dSphereClass, 0, true); });
    refused("impossible levels", [](Bytes &b) { b.hash_space(2, 3, 2); });
    refused("impossible levels", [](Bytes &b) { b.hash_space(2, -2000, 2); });
    refused("impossible levels", [](Bytes &b) { b.hash_space(2, 0, 2000); });
    refused("moved to another space", [](Bytes &b) { b.change(1, dSphereClass, geom_field::parent, 0); });
    refused("a body does not exist", [](Bytes &b) { b.change(1, dSphereClass, geom_field::body, 2); });
    good.mesh(1, 2).geom(2, dTriMeshClass).geom(3, dCapsuleClass);
    refused("do not exist", [](Bytes &b) { b.change(2, dTriMeshClass, geom_field::data, 1); });
    refused("negative or not a number", [](Bytes &b) {
        b.begin(RecordKind::geom).number<std::uint32_t>(3).number<std::uint8_t>(dCapsuleClass);
        b.number<std::uint16_t>(geom_field::size).reals(1).reals(1, -1).end();
    });
    refused("another class", [](Bytes &b) { b.change(1, dBoxClass, geom_field::body, 0); });
    refused("or has pairs", [](Bytes &b) { b.pairs(0); });
    refused("event of these pairs does not exist", [](Bytes &b) { b.pairs(2); });
    refused("event of these times does not exist", [](Bytes &b) { b.times(2, 0); });
    refused("negative or not finite", [](Bytes &b) { b.times(1, -1); });
    refused("or has times", [](Bytes &b) { b.times(0, 0); });
    refused("reason of the end is unknown", [](Bytes &b) { b.begin(RecordKind::end).number<std::uint8_t>(7).end(); });
}

TEST(Recording, RefusesWhatIsDoneWithAGeomThatIsGone)
{
    Bytes good;
    good.geom(0, dHashSpaceClass).geom(1, dSphereClass, 1).event(RecordKind::gone, {0});
    Refusals{good}("a geom does not exist", [](Bytes &b) { b.event(RecordKind::collide, {0}); });
    Refusals{good}("gone", [](Bytes &b) { b.geom(2, dSphereClass, 1); });
    Refusals{good}("a geom does not exist", [](Bytes &b) { b.event(RecordKind::gone, {0}); });
}

TEST(Recording, RefusesWhatFollowsTheEndAndSpacesThatAreTooDeep)
{
    Bytes ended;
    ended.begin(RecordKind::end).number<std::uint8_t>(0).end();
    Refusals{ended}("follows the end", [](Bytes &b) { b.geom(0, dSphereClass); });
    Bytes deep;
    for (std::uint32_t id = 0; id <= deepest_nesting; ++id)
        deep.geom(id, dSimpleSpaceClass, id);
    Refusals{deep}("too deeply", [](Bytes &b) { b.geom(deepest_nesting + 1, dSimpleSpaceClass, deepest_nesting + 1); });
}
} // namespace
} // namespace ode_predictive_space::recording
