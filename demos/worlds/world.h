// A world: what the demos show, the tests check and the benchmarks measure. It moves in the same way in every space: make it
// once per space from the same specification, and every difference is due to the space. A tick of it:
// world->advance(); pairs.clear(); world->collide(space, &pairs, PairList::near); world->respond(pairs.sorted());

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_WORLD_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_WORLD_H

#include "demos/worlds/objects.h"
#include "demos/worlds/pair_list.h"
#include "ode_predictive_space/haptics/device/random.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ode_predictive_space::worlds
{
/// Number of contacts that dCollide() may return for a pair.
constexpr int max_contacts = 8;

struct WorldSpec
{
    std::string name;       ///< one of world_names()
    int objects = 100;      ///< n, >= 1; each world says what it counts
    std::uint64_t seed = 1; ///< of positions, motions, the hand; worlds of the same seed are the same
    double moving = -1;     ///< share of the objects that move, 0 … 1, in gas and churn; < 0: the world's own, a half
    bool own_probe = true;  ///< of mix: false omits the probe; the caller brings one and handles its pairs
};

struct Bounds
{
    Vector3 centre;
    Vector3 half_extent;
};

inline Bounds cube(double half)
{
    return {Vector3::Zero(), Vector3::Constant(half)};
}

/// A square around the origin, of this height above and below.
inline Bounds square(double half, double half_height)
{
    return {Vector3::Zero(), {half, half, half_height}};
}

constexpr double thin = 0.01;  ///< share of the volume that objects fill
constexpr double dense = 0.05; ///< the same

/// Half the side of a room for usual objects that has no geoms, metres.
inline double half_gas_room(int objects, double volume_fraction)
{
    return std::max(half_room(objects, volume_fraction), 2 * object_radius);
}

inline std::function<Bounds(int)> gas_bounds(double volume_fraction)
{
    return [volume_fraction](int objects) { return cube(half_gas_room(objects, volume_fraction)); };
}

/// A running world. The space of its geoms must outlive it.
class World
{
public:
    World(const WorldSpec &spec, dSpaceID space) : objects_(space), random_(spec.seed) {}
    virtual ~World() = default;
    World(const World &) = delete;
    World &operator=(const World &) = delete;

    virtual void advance() = 0;

    /// Calls the space for the pairs of a tick: dSpaceCollide(), unless the world overrides it.
    virtual void collide(dSpaceID space, void *data, const NearCallbacks &near);

    /// Process the pairs that collide() reported after advance(), as PairList::sorted() gives them. Worlds with contacts need
    /// the pairs of every tick.
    virtual void respond(const std::vector<IndexPair> &) {}

    /// Contacts that the last respond() made.
    std::size_t contacts() const { return contacts_; }

    /// Whether respond() may be omitted: the motion does not depend on the pairs.
    virtual bool moves_by_itself() const { return true; }

    /// All geoms of the world by their numbers; null for destroyed ones. (Not every space can enumerate its geoms.)
    virtual const std::vector<dGeomID> &geoms() const { return objects_.geoms(); }

    /// Geoms in no space, for a dSpaceCollide2() with the world's space in each tick; none in most worlds. Their numbers follow
    /// those of the world's geoms.
    virtual const std::vector<dGeomID> &queries() const;

protected:
    Objects objects_;
    haptics::Random random_;
    std::size_t contacts_ = 0;
};

enum class Group
{
    scene,   ///< one thing at a time; what the demos show
    stepped, ///< one thing at a time, moved by dWorldStep() with contacts
    program, ///< as programs have them
    limit    ///< very many, very large, very near, very far
};

using MakeWorld = std::function<std::unique_ptr<World>(dSpaceID)>;

/// Properties of a world that are known before it is made.
struct WorldEntry
{
    Group group;
    std::string name;
    std::string text; ///< one sentence: what happens, and what its number of objects counts
    int objects;      ///< n, if nothing else is said
    double step;      ///< simulated seconds of one tick
    std::function<Bounds(int objects)> bounds;
    std::function<MakeWorld(const WorldSpec &)> prepare; ///< makes once what all copies share
};

/// The usual WorldEntry::prepare: nothing is shared.
template <typename Kind, typename... Arguments>
std::function<MakeWorld(const WorldSpec &)> made_of(Arguments... arguments)
{
    return [=](const WorldSpec &spec) -> MakeWorld {
        return [=](dSpaceID space) { return std::make_unique<Kind>(spec, space, arguments...); };
    };
}

const std::vector<WorldEntry> &all_worlds();

/// @throws std::invalid_argument for a name that no world has.
const WorldEntry &world_named(const std::string &name);

std::vector<std::string> world_names(Group group);

/// Makes copies of one world. Long preparations (a pile must settle) are made once, here.
class WorldFactory
{
public:
    /// @throws std::invalid_argument for a name that no world has, or for less than one object.
    explicit WorldFactory(const WorldSpec &spec);

    /// A new copy, its geoms in this space; in none when it is null.
    std::unique_ptr<World> make(dSpaceID space) const { return make_(space); }

    const WorldSpec &spec() const { return spec_; }

    /// The bounds of the world, which a quadtree space needs in advance.
    Bounds bounds() const { return entry_.bounds(spec_.objects); }

    double tick_seconds() const { return entry_.step; } ///< s, simulated

private:
    WorldSpec spec_;
    const WorldEntry &entry_;
    MakeWorld make_;
};

/// In explosion all velocities change in every tick whose number, counted from 1, is a multiple of this.
constexpr int ticks_between_explosions = 200;

/// In reset and recentre everything moves at once in the first tick and then once in so many.
constexpr int ticks_between_events = 200;

/// Ticks after which each of the worlds of many is destroyed.
constexpr int ticks_of_life = 60;

WorldSpec life_of_many(const WorldSpec &spec);

/// Spheres that ask in query and in ask, and as many rays.
constexpr int asking_spheres = 20;
} // namespace ode_predictive_space::worlds

#endif
