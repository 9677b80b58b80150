#include "ode_predictive_space/recording/recorder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <new>
#include <type_traits>
#include <utility>

#include <ode/odeconfig.h>

#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/recording/fields.h"

namespace ode_predictive_space::recording
{
namespace
{
std::string header()
{
    std::string text(magic, sizeof magic);
    for (std::uint32_t number : {format_version, static_cast<std::uint32_t>(sizeof(dReal))})
        text.append(reinterpret_cast<const char *>(&number), sizeof number);
    return text;
}

RecordKind kind_of_data(int geom_class)
{
    return geom_class == dConvexClass    ? RecordKind::convex
           : geom_class == dTriMeshClass ? RecordKind::mesh
                                         : RecordKind::heights;
}

constexpr std::size_t end_size = record_header_size + 1;
constexpr std::size_t pairs_size = record_header_size + 2 * sizeof(std::uint32_t) + sizeof(std::uint64_t);
constexpr std::size_t times_size = record_header_size + sizeof(std::uint32_t) + sizeof(EventTimes);
} // namespace

// Appends one record to the buffer. The destructor writes its size.
class Recorder::Record
{
public:
    Record(std::string &buffer, RecordKind kind) : buffer_(buffer), begin_(buffer.size())
    {
        buffer_.append(sizeof(std::uint32_t), '\0');
        buffer_.push_back(static_cast<char>(kind));
    }
    ~Record()
    {
        const auto size = static_cast<std::uint32_t>(buffer_.size() - begin_ - record_header_size);
        std::memcpy(&buffer_[begin_], &size, sizeof size);
    }
    Record(const Record &) = delete;
    Record &operator=(const Record &) = delete;

    template <typename Value> Record &add(const Value &value)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        add_bytes(&value, sizeof value);
        return *this;
    }
    void add_bytes(const void *bytes, std::size_t size) { buffer_.append(static_cast<const char *>(bytes), size); }
    void add_text(const std::string &text) { buffer_ += text; }

private:
    std::string &buffer_;
    std::size_t begin_;
};

Recorder::Recorder(HistoryFile file, std::uint64_t limit, const std::string &note,
                   std::function<bool(dSpaceID)> is_substitute)
    : file_(std::move(file)), limit_(limit), buffer_(header()), is_substitute_(std::move(is_substitute))
{
    Record(buffer_, RecordKind::note).add_text(note);
}

Recorder::~Recorder()
{
    close();
}

bool Recorder::close()
{
    ode_predictive_space_stop_listening(&notices_);
    const std::lock_guard<std::mutex> guard(mutex_);
    if (!over_ && append([&] { Record(buffer_, RecordKind::end).add(EndReason::closed); }))
        file_.write(buffer_);
    over_ = true;
    return file_.close();
}

void Recorder::leave_to_parent()
{
    over_ = true;
    file_.abandon();
}

// Appends records as a whole or, when memory runs out, not at all.
template <typename Make> bool Recorder::append(Make make)
{
    const std::size_t before = buffer_.size();
    try
    {
        make();
        return true;
    }
    catch (const std::bad_alloc &)
    {
        buffer_.resize(before);
        cut();
        return false;
    }
}

// Writes no end record, because a recording with one is whole.
void Recorder::cut()
{
    file_.write(buffer_);
    file_.give_up(ENOMEM);
    over_ = true;
}

template <typename Make> Recorder::Event Recorder::begin_event(Make make)
{
    const std::lock_guard<std::mutex> guard(mutex_);
    const std::size_t before = buffer_.size();
    if (over_ || !append(make))
        return {nullptr, 0};
    return write_event(before);
}

Recorder::Event Recorder::begin_collide(dSpaceID space)
{
    return begin_event([&] {
        inspect(space, true);
        Record(buffer_, RecordKind::collide).add(geoms_.at(space).id);
    });
}

Recorder::Event Recorder::begin_collide2(dGeomID first, dGeomID second)
{
    return begin_event([&] {
        inspect(first, false);
        inspect(second, false);
        Record(buffer_, RecordKind::collide2).add(geoms_.at(first).id).add(geoms_.at(second).id);
    });
}

// The event is written before the collide, because the program may not survive it.
Recorder::Event Recorder::write_event(std::size_t before)
{
    const std::size_t still_to_come = (unfinished_ + 1) * (pairs_size + times_size) + end_size;
    if (file_.size() + buffer_.size() + still_to_come > limit_)
    {
        buffer_.resize(before);
        Record(buffer_, RecordKind::end).add(EndReason::limit);
        over_ = true;
    }
    if (!file_.write(buffer_))
        over_ = true;
    buffer_.clear();
    if (over_)
        return {nullptr, 0};
    ++unfinished_;
    return {this, next_event_++};
}

void Recorder::Event::note(dGeomID first, dGeomID second)
{
    if (!recorder_ || recorder_->over_)
        return;
    const std::lock_guard<std::mutex> guard(recorder_->mutex_);
    const auto one = recorder_->geoms_.find(first), other = recorder_->geoms_.find(second);
    const auto end = recorder_->geoms_.end();
    ++pairs_;
    if (one != end && other != end)
        hash_ += hash_of_pair(one->second.id, other->second.id);
}

void Recorder::Event::end(const EventTimes *times)
{
    if (!recorder_ || recorder_->over_)
        return;
    const std::lock_guard<std::mutex> guard(recorder_->mutex_);
    if (recorder_->over_)
        return;
    --recorder_->unfinished_;
    recorder_->append([&] {
        Record(recorder_->buffer_, RecordKind::pairs).add(number_).add(pairs_).add(hash_);
        if (times)
            Record(recorder_->buffer_, RecordKind::times).add(number_).add(*times);
    });
}

// For a geom in a space that is not known yet, the walk begins at its outermost space.
void Recorder::inspect(dGeomID geom, bool is_collide)
{
    ++walk_;
    walked_.clear();
    has_absent_ = false;
    dGeomID begin = geom;
    if (geom->parent_space && !is_known(geom->parent_space))
        while (begin->parent_space)
            begin = begin->parent_space;
    noticed_.clear();
    visit(begin, is_collide);
    write_notices();
    forget_absent();
}

// Another geom may have been at this address before.
bool Recorder::is_known(dGeomID geom) const
{
    const auto known = geoms_.find(geom);
    return known != geoms_.end() && known->second.state.geom_class == geom->type;
}

void Recorder::visit(dGeomID geom, bool is_collide)
{
    bool body_changed = false;
    GeomState state = state_of(geom);
    state.parent = geom->parent_space ? geoms_.at(geom->parent_space).id + 1 : 0;
    state.body = body_of(geom, body_changed);
    if (IS_SPACE(geom))
        state.service = service_of(static_cast<dSpaceID>(geom));
    take_shape_data(geom, is_collide, state);

    auto [place, is_new] = geoms_.try_emplace(geom, Known{next_geom_, 0, {}});
    Known &known = place->second;
    std::uint16_t fields = is_new ? geom_field::all : difference(known.state, state);
    // Another geom at this address counts as new, and so does one that has moved to another space: ODE's spaces leave stale
    // state in a geom, on which other spaces fail.
    if (!is_new && (fields & (geom_field::is_new | geom_field::parent)))
    {
        Record(buffer_, RecordKind::gone).add(known.id);
        known.id = next_geom_;
        fields = geom_field::all;
    }
    if (fields == geom_field::all)
        ++next_geom_;
    // The pose of a geom with an offset changes with its body. It is recorded, so that a replay has it to the last bit.
    if (body_changed && has_own_pose(state))
        fields |= geom_field::pose;
    known.seen = walk_;
    count_member(known.state.parent, -1);
    count_member(state.parent, 1);
    known.state = state;
    if (fields)
        write_geom(known, fields);
    take_notices(geom, known, fields, body_changed);
    if (IS_SPACE(geom))
        visit_members(static_cast<dSpaceID>(geom), is_collide);
}

SpaceService Recorder::service_of(dSpaceID space)
{
    SpaceService service;
    if (!dSpaceIsPredictive(space))
        return service;
    ode_predictive_space_listen(space, &notices_);
    service.predictive = static_cast<std::uint8_t>(1 + dPredictiveSpaceGetProximity(space));
    service.is_substitute = is_substitute_(space);
    return service;
}

void Recorder::take_notices(dGeomID geom, const Known &known, std::uint16_t fields, bool body_changed)
{
    if (!geom->parent_space || !geoms_.at(geom->parent_space).state.service.predictive)
        return;
    const bool other_box = known.state.geom_class == stand_in && (fields & geom_field::size);
    const bool other_pose = body_changed || (fields & geom_field::pose) || other_box;
    const std::uint32_t usual = other_pose && !(fields & geom_field::is_new) ? 1 : 0;
    const std::uint32_t number = std::min(notices_.take(geom), most_notices);
    if (number != usual)
        noticed_.push_back({known.id, number});
}

void Recorder::write_notices()
{
    if (noticed_.empty())
        return;
    Record record(buffer_, RecordKind::notices);
    for (const auto &each : noticed_)
        record.add(each);
}

// Visits the geoms from last to first, because a space inserts new geoms at the front: a replay then has the same order.
void Recorder::visit_members(dSpaceID space, bool is_collide)
{
    std::vector<dGeomID> members;
    for (dGeomID geom = space->first; geom; geom = geom->next)
        members.push_back(geom);
    const std::uint32_t id = geoms_.at(space).id;
    walked_.push_back(id);
    for (auto geom = members.rbegin(); geom != members.rend(); ++geom)
        visit(*geom, is_collide);
    has_absent_ |= member_counts_[id + 1] != members.size();
}

void Recorder::count_member(std::uint32_t parent, int change)
{
    member_counts_[parent] += static_cast<std::size_t>(change);
}

std::uint32_t Recorder::body_of(dGeomID geom, bool &changed)
{
    if (!geom->body)
        return 0;
    auto [place, is_new] = bodies_.try_emplace(geom->body, KnownBody{next_body_, 0, false, {}});
    KnownBody &known = place->second;
    if (known.seen != walk_)
    {
        const BodyState state = state_of(geom->body);
        const std::uint16_t fields = is_new ? body_field::all : difference(known.state, state);
        next_body_ += is_new;
        known.seen = walk_;
        known.changed = fields & body_field::pose;
        known.state = state;
        if (fields)
            write_body(known, fields);
    }
    changed = known.changed;
    return known.id + 1;
}

void Recorder::take_shape_data(dGeomID geom, bool is_collide, GeomState &state)
{
    if (!has_data(state.geom_class))
        return;
    ShapeData::Entry entry{};
    std::string content;
    if (!shape_data_.find(shape_of(geom), is_collide ? walk_ : 0, entry, content))
        return make_stand_in(geom, state);
    if (entry.is_new)
        Record(buffer_, kind_of_data(state.geom_class)).add(entry.id).add_text(content);
    state.data = entry.id;
}

void Recorder::write_body(const KnownBody &known, std::uint16_t fields)
{
    Record record(buffer_, RecordKind::body);
    record.add(known.id).add(fields);
    visit_body_fields(known.state, fields, [&](const void *field, std::size_t size) { record.add_bytes(field, size); });
}

void Recorder::write_geom(const Known &known, std::uint16_t fields)
{
    Record record(buffer_, RecordKind::geom);
    record.add(known.id).add(known.state.geom_class).add(fields);
    visit_geom_fields(known.state, fields, [&](const void *field, std::size_t size) { record.add_bytes(field, size); });
}

// A geom that comes back is new.
void Recorder::forget_absent()
{
    if (!has_absent_)
        return;
    std::sort(walked_.begin(), walked_.end());
    for (auto place = geoms_.begin(); place != geoms_.end();)
    {
        const Known &known = place->second;
        const bool absent = known.seen != walk_ && known.state.parent != 0 &&
                            std::binary_search(walked_.begin(), walked_.end(), known.state.parent - 1);
        if (absent)
        {
            Record(buffer_, RecordKind::gone).add(known.id);
            notices_.take(place->first);
            count_member(known.state.parent, -1);
        }
        place = absent ? geoms_.erase(place) : std::next(place);
    }
}

std::string note_of_process()
{
    return std::string("recorded by ode_predictive_space from ") + program_invocation_short_name + "; " +
           dGetConfiguration();
}
} // namespace ode_predictive_space::recording
