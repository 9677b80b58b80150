// What the broad phase keeps of each object: its place, and what its next prediction is made of.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_PROXY_STORE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_PROXY_STORE_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/base/prefetch.h"
#include "ode_predictive_space/broadphase/objects/place.h"

namespace ode_predictive_space
{
/// The part of the index that an envelope is in.
enum class TreeKind : std::uint8_t
{
    none,
    tree,
    list ///< of those that no tree can hold, and of all in a small scene
};

/// The role of an object, and whether the program or the space chose it.
enum class Role : std::uint8_t
{
    environment,       ///< by default
    interactive,       ///< recognised: the object moved without a body to tell its velocity
    fixed_environment, ///< set by the program
    fixed_interactive  ///< set by the program
};

inline bool is_interactive(Role role)
{
    return role == Role::interactive || role == Role::fixed_interactive;
}

/// The last prediction of an object, and what came of it. One cache line. Written by predict, but for the shelf.
struct alignas(64) ProxyRecord
{
    float position[3];     ///< of the centre, where the path begins
    float velocity[3];     ///< of the body, in the program's unit; per tick of an object without one
    float acceleration[3]; ///< per tick^2
    float reach;           ///< how far ahead the envelope reaches, in sizes; adapts
    float spread;          ///< how far the object was off its paths, as a part of the way; adapts
    float size;            ///< the largest side
    float radius;          ///< of a sphere around the centre that holds the object; may be infinite
    Tick since;            ///< the tick of the prediction, or of a later leap
    std::uint16_t tests;   ///< pairs that were tested since then
    std::uint16_t useless; ///< of these, pairs that were apart at the end
    Role role;             ///< set by the program; predict recognises Role::interactive
    TreeKind tree_kind;    ///< written by the index
    bool predicted : 1;    ///< at least once
    bool has_body : 1;     ///< which tells the velocity
    bool is_rounded : 1;   ///< it was so far away that rounding made much of its box
    bool leapt : 1;        ///< since the prediction
    bool is_costly : 1;    ///< the contacts of its shape are costly to find

    bool had_overlap() const { return useless < tests; }
    /// Had it a body that is not kinematic at the last prediction, or has it moved by then, or leapt since?
    bool can_move() const { return has_body || leapt || is_interactive(role); }
};
static_assert(sizeof(ProxyRecord) == 64, "one cache line");

/// The objects. Numbers are reused, the last one given back first.
class ProxyStore
{
public:
    std::vector<Place, CacheLineAllocator<Place>> places;
    std::vector<ProxyRecord> records;

    /// Should the pair be tested by shape? Its contacts are costly to find, or the program has said of one of the two that a person drives it.
    /// Two costly objects that cannot move are tested by box: they are pieces of a landscape.
    bool is_checked_by_shape(ProxyId first, ProxyId second) const
    {
        const ProxyRecord &one = records[first], &other = records[second];
        if (one.is_costly && other.is_costly)
            return one.can_move() || other.can_move();
        return one.is_costly || other.is_costly || one.role == Role::fixed_interactive ||
               other.role == Role::fixed_interactive;
    }

    /// Has the program said of any object that a person drives it?
    bool any_hand() const { return hands_ > 0; }

    void set_role(ProxyId id, Role role)
    {
        hands_ -= records[id].role == Role::fixed_interactive;
        hands_ += role == Role::fixed_interactive;
        records[id].role = role;
    }

    /// Numbers in use are below this.
    std::size_t size() const { return records.size(); }
    std::size_t count() const { return count_; }
    const IdSet &members() const { return members_; }

    /// Makes room for so many more objects. On an exception nothing has changed.
    void make_room(std::size_t more)
    {
        if (free_.size() >= more)
            return;
        const std::size_t before = size(), room = before + more - free_.size();
        if (free_.capacity() < room)
            free_.reserve(room + room / 4);
        resize(room);
        const auto added = free_.insert(free_.begin(), room - before, ProxyId{0});
        std::generate_n(added, room - before, [next = room]() mutable { return static_cast<ProxyId>(--next); });
    }

    /// A new object, without an envelope. Throws nothing after make_room().
    ProxyId add()
    {
        make_room(1);
        const ProxyId id = free_.back();
        free_.pop_back();
        places[id] = Place();
        records[id] = ProxyRecord{};
        members_.insert(id);
        ++count_;
        return id;
    }

    /// Throws nothing.
    void remove(ProxyId id)
    {
        set_role(id, Role::environment);
        free_.push_back(id); // has room for all
        members_.erase(id);
        --count_;
    }

    /// All numbers in use are below this.
    std::size_t needed_size() const
    {
        std::size_t needed = 0;
        members_.for_each([&](ProxyId id) { needed = id + std::size_t{1}; });
        return needed;
    }

    /// Gives back the memory of numbers that are not needed. Throws nothing.
    void trim()
    {
        const std::size_t needed = needed_size();
        resize(needed);
        free_.erase(std::remove_if(free_.begin(), free_.end(), [&](ProxyId id) { return id >= needed; }), free_.end());
        const std::size_t left = free_.size();
        free_.resize(needed); // keeps room for all
        free_.shrink_to_fit();
        free_.resize(left);
    }

    std::size_t bytes() const { return bytes_of(places) + bytes_of(records) + bytes_of(free_) + members_.bytes(); }

private:
    void resize(std::size_t size)
    {
        resize_array(places, size);
        members_.resize(size);
        resize_array(records, size); // last: it tells the size
    }

    IdSet members_;
    std::size_t count_ = 0;     // of members_
    std::size_t hands_ = 0;     // of these, Role::fixed_interactive
    std::vector<ProxyId> free_; // numbers, the next one last; has room for all
};
} // namespace ode_predictive_space

#endif
