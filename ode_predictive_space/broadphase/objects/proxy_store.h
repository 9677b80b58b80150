// The objects of the broad phase: the place of each, and the record that its next prediction uses.

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
enum class TreeKind : std::uint8_t
{
    none,
    tree,
    list ///< for envelopes that no tree can hold, and for all of a small scene
};

enum class Role : std::uint8_t
{
    environment,       ///< by default
    interactive,       ///< recognised, because the object moved without a dynamic body
    fixed_environment, ///< set by the program
    fixed_interactive  ///< set by the program
};

inline bool is_interactive(Role role)
{
    return role == Role::interactive || role == Role::fixed_interactive;
}

/// The last prediction of an object, and the tests of its pairs since then.
struct alignas(64) ProxyRecord
{
    float position[3];     ///< the centre, where the path begins
    float velocity[3];     ///< with a body in the program's unit, otherwise per tick
    float acceleration[3]; ///< per tick^2
    float reach;           ///< in sizes; adapts
    float spread;          ///< deviation per distance travelled; adapts
    float size;            ///< the largest side
    float radius;          ///< a sphere of it around the centre holds the object; may be infinite
    Tick since;            ///< the tick of the prediction, or of a later leap
    std::uint16_t tests;   ///< pairs that were tested since then
    std::uint16_t useless; ///< tested pairs that were apart at the end
    Role role;
    TreeKind tree_kind;  ///< written by the index
    bool predicted : 1;  ///< at least once
    bool has_body : 1;   ///< the velocity is that of a body
    bool is_rounded : 1; ///< rounding dominates the box, because the object is far from the origin
    bool leapt : 1;      ///< since the prediction
    bool is_costly : 1;  ///< contacts of the shape are costly to find

    bool can_move() const { return has_body || leapt || is_interactive(role); }
};
static_assert(sizeof(ProxyRecord) == 64, "one cache line");

class ProxyStore
{
public:
    std::vector<Place, CacheLineAllocator<Place>> places;
    std::vector<ProxyRecord> records;

    /// Whether the shape test applies to the pair: its contacts are costly to find, or the program has made one object
    /// interactive. Two costly objects that cannot move are pieces of a landscape, and are tested by box.
    bool is_checked_by_shape(ProxyId first, ProxyId second) const
    {
        const ProxyRecord &one = records[first], &other = records[second];
        if (one.is_costly && other.is_costly)
            return one.can_move() || other.can_move();
        return one.is_costly || other.is_costly || one.role == Role::fixed_interactive ||
               other.role == Role::fixed_interactive;
    }

    bool any_hand() const { return hands_ > 0; }

    void set_role(ProxyId id, Role role)
    {
        hands_ -= records[id].role == Role::fixed_interactive;
        hands_ += role == Role::fixed_interactive;
        records[id].role = role;
    }

    /// All numbers are below this.
    std::size_t size() const { return records.size(); }
    std::size_t count() const { return members_.size(); }
    const IdSet &members() const { return members_; }

    /// Makes room for `more` objects. On an exception nothing has changed.
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

    /// Adds an object without an envelope. Throws nothing after make_room().
    ProxyId add()
    {
        make_room(1);
        const ProxyId id = free_.back();
        free_.pop_back();
        places[id] = Place();
        records[id] = ProxyRecord{};
        members_.insert(id);
        return id;
    }

    /// Throws nothing.
    void remove(ProxyId id)
    {
        set_role(id, Role::environment);
        free_.push_back(id); // has room for all
        members_.erase(id);
    }

    /// All numbers in use are below this.
    std::size_t needed_size() const
    {
        std::size_t needed = 0;
        members_.for_each([&](ProxyId id) { needed = id + std::size_t{1}; });
        return needed;
    }

    /// Gives back the memory of numbers from needed_size() on. Throws nothing.
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
        resize_array(records, size); // last, because size() reads it
    }

    IdSet members_;
    std::size_t hands_ = 0;     // members with Role::fixed_interactive
    std::vector<ProxyId> free_; // the next number last; has room for all
};
} // namespace ode_predictive_space

#endif
