// The arrays of meshes, convexes and heightfields, each recorded once.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_SHAPE_DATA_H
#define ODE_PREDICTIVE_SPACE_RECORDING_SHAPE_DATA_H

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>

#include <ode/common.h>

namespace ode_predictive_space::recording
{
class ShapeData
{
public:
    struct Entry
    {
        std::uint32_t id;
        bool is_new; ///< its content has no record yet
    };

    /// Reads arrays as a record has them, without the id. @return false if they are unreadable, or a reader would refuse them.
    static bool read(dGeomID geom, std::string &content);

    /// Finds or makes the entry of a geom's arrays. @return as read() does. @param content receives the content of a new entry.
    /// @param collide number of the collide that begins. Known arrays are read again once in it, because their content may have
    /// changed, except for a heightfield with a callback; 0: they are not read again.
    bool find(dGeomID geom, std::uint64_t collide, Entry &entry, std::string &content);

private:
    struct Key
    {
        const void *first, *second, *third;
        std::array<std::uint32_t, 5> numbers; // counts and strides
        std::array<dReal, 4> sizes;           // of a heightfield
        bool operator<(const Key &other) const;
    };
    static bool key_of(dGeomID geom, Key &key);

    struct Known
    {
        std::uint32_t id;
        std::uint64_t looked_at; // in this collide
    };
    std::map<Key, Known> known_;
    std::unordered_map<std::uint64_t, std::uint32_t> by_hash_;
    std::uint32_t next_ = 0;
};
} // namespace ode_predictive_space::recording

#endif
