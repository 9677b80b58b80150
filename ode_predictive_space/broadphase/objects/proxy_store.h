// What the broad phase keeps of each object: its predicted path, its envelope, and what the stages note beside them.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_PROXY_STORE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_PROXY_STORE_H

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "ode_predictive_space/broadphase/base/float_box.h"
#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/base/prefetch.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// The hot half of an object's prediction: where its centre may be. One cache line, the only one that a check of the centre
/// reads. Written by predict.
///
/// Velocity, acceleration and deviation are floats: the path is *defined* by the rounded values. The coefficients of the
/// deviation lie behind the velocity and the acceleration, as those of a fourth axis: four floats are computed with at once.
struct alignas(64) PackedPath
{
    double position[3];
    float deviation_base; ///< a of R(t) = a + b t + c t^2
    Tick since;           ///< tick of the prediction: time 0 of path and deviation
    float velocity[3];
    float deviation_rate; ///< b
    float half_acceleration[3];
    float deviation_bend; ///< c

    void set_path(const Path &path)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            position[axis] = path.position[axis];
            velocity[axis] = static_cast<float>(path.velocity[axis]);
            half_acceleration[axis] = static_cast<float>(0.5 * path.acceleration[axis]);
        }
    }

    void set_deviation(const Deviation &R)
    {
        // A limit far beyond any scene, so that no product of it with a time is infinite or NaN.
        constexpr double limit = 1e30;
        deviation_base = static_cast<float>(std::min(R.a, limit));
        deviation_rate = static_cast<float>(std::min(R.b, limit));
        deviation_bend = static_cast<float>(std::min(R.c, limit));
    }

    Deviation deviation() const { return {deviation_base, deviation_rate, deviation_bend}; }

    /// R(t), as verification computes it.
    float reach(float t) const { return deviation_base + t * (deviation_rate + t * deviation_bend); }

    Path path() const
    {
        return {Vector3(position[0], position[1], position[2]), Vector3(velocity[0], velocity[1], velocity[2]),
                2 * Vector3(half_acceleration[0], half_acceleration[1], half_acceleration[2])};
    }
};
static_assert(sizeof(PackedPath) == 64, "one cache line per checked object");

/// How an object is checked against its envelope.
enum class Check : std::uint8_t
{
    none,   ///< not predicted
    bounds, ///< its bounding box must lie within the envelope
    centre  ///< its centre must be within the deviation of the path, and its size must not have grown
};

/// The part of the index that an envelope is in.
enum class Shelf : std::uint8_t
{
    none,
    still,  ///< the tree of envelopes that do not move
    moving, ///< the tree of swept envelopes
    list,   ///< the list of those that no tree can hold, and of all in a small scene
    idle    ///< the tree of disabled objects, for which no pairs are looked for
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

/// The cold half of an object's prediction, grouped by the stage that writes it. One cache line.
struct alignas(64) ProxyRecord
{
    /// The envelope around the path. Written by predict.
    struct Prediction
    {
        float low[3];  ///< bounds relative to the path
        float high[3]; ///< the same
        float radius;  ///< of a sphere around the path that holds the object; may be infinite
        Tick until;    ///< end of the horizon; a still object has none, unless it is later than the prediction
    } prediction;

    /// What earlier predictions taught. Written by predict.
    struct Learned
    {
        float last_velocity[3]; ///< of the body, in the program's unit, at the last prediction
        float spread;           ///< growth of the deviation per tick, as adapted
        std::uint32_t horizon;  ///< in ticks, as adapted; 0 before the first prediction that is more than a guess
        std::uint32_t history;  ///< number of the object's history, or no_history
    } learned;

    /// What kind of prediction this is. Written by predict.
    struct Kind
    {
        Check check;
        bool still;             ///< path and deviation are constant: valid until the object leaves its envelope
        bool tight_bounds_last; ///< bounds are tighter than those of the bounding sphere, and the object hardly turns
        bool crowded;           ///< the object has or had near pairs: tight bounds pay
        std::uint8_t mistrust;  ///< times in a row that the body's velocity did not explain the motion
    } kind;

    /// Set by the program; predict recognises Role::interactive.
    Role role;

    /// Where the envelope is in the index. Written by the index.
    struct Placement
    {
        Shelf shelf;
        bool unbounded; ///< no tree can hold the envelope: infinite, or not a number
    } placement;
};
static_assert(sizeof(ProxyRecord) == 64, "one cache line");
constexpr std::uint32_t no_history = ~std::uint32_t{0};

/// What the notice of a move is judged by, beside the path. Predict begins it anew; verify keeps the pose.
///
/// An object whose radius is not negative is checked by its centre, at once. All others need a closer look.
struct Stamp
{
    static constexpr float unpredicted = -std::numeric_limits<float>::infinity(), by_bounds = -1;

    float radius = unpredicted; ///< of the sphere that is checked by its centre; negated while the pose is kept in full
    std::uint32_t pose = 0;     ///< digest of the pose at the last notice; 0 when that is not known

    /// With a closer look, the lowest bit is none of the digest: the pose at the last notice is kept in full.
    static constexpr std::uint32_t kept = 1;
    bool is_kept() const { return std::signbit(radius) && (pose & kept) != 0; }
    bool may_be(std::uint32_t digest) const { return pose != 0 && digest != 0 && ((pose ^ digest) & ~kept) == 0; }

    void set(std::uint32_t digest, bool by_centre, bool is_kept)
    {
        const bool at_once = by_centre && !is_kept;
        radius = std::copysign(radius, at_once ? 1.0f : -1.0f);
        pose = at_once || digest == 0 ? digest : (digest & ~kept) | (is_kept ? kept : 0);
    }
};

/// All objects, by number. Plain arrays: each stage of the tick reads and writes the part that it is about.
class ProxyStore
{
public:
    std::vector<PackedPath> paths;
    std::vector<ProxyRecord> records;
    std::vector<Stamp> stamps;
    std::vector<Generation> generations;

    /// @param scene_epsilon of the scene's coordinates; 0 for double precision, whose rounding is allowed for anyway.
    explicit ProxyStore(double scene_epsilon = 0) : scene_epsilon_(scene_epsilon) {}

    /// Numbers in use or free: all are below this.
    std::size_t size() const { return generations.size(); }
    /// Objects that are there.
    std::size_t count() const { return count_; }
    const IdSet &members() const { return members_; }

    /// Makes room for one more object. On an exception nothing has changed.
    void make_room()
    {
        if (!free_.empty())
            return;
        const std::size_t room = size() + 1;
        if (free_.capacity() < room)
            free_.reserve(room + room / 4);
        resize(room);
        free_.push_back(static_cast<ProxyId>(room - 1));
    }

    /// A new object, without a prediction. Throws nothing after make_room().
    ProxyId add()
    {
        make_room();
        const ProxyId id = free_.back();
        free_.pop_back();
        forget(id);
        members_.insert(id);
        ++count_;
        return id;
    }

    /// Throws nothing.
    void remove(ProxyId id)
    {
        free_.push_back(id); // has room for all
        ++generations[id];
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

    /// Forgets how an object was predicted, but not what was learned about it.
    void forget_prediction(ProxyId id)
    {
        records[id].kind.check = Check::none;
        stamps[id] = Stamp{};
    }

    bool predicted(ProxyId id) const { return records[id].kind.check != Check::none; }

    /// The envelope of an object, its time counted from `now` on.
    Envelope envelope(ProxyId id, Tick now) const { return from_now(id, paths[id].deviation(), now); }

    /// The same, larger by what rounding can do in verification, which computes in single precision how far path and deviation
    /// have come, and in a scene of single precision: an object that passed verification is inside.
    Envelope outer_envelope(ProxyId id, Tick now) const
    {
        Deviation outer = paths[id].deviation();
        outer.a += rounding_of_scene(id);
        if (!records[id].kind.still)
        {
            constexpr double rounding = 8 * std::numeric_limits<float>::epsilon();
            const Path path = paths[id].path();
            outer.a += rounding * paths[id].deviation_base;
            outer.b += rounding * (outer.b + path.velocity.lpNorm<Eigen::Infinity>());
            outer.c += rounding * (outer.c + path.acceleration.lpNorm<Eigen::Infinity>());
        }
        return from_now(id, outer, now);
    }

    /// Ticks from `now` on for which an envelope is valid; a very large number for still ones.
    std::int32_t remaining(ProxyId id, Tick now) const
    {
        return records[id].kind.still ? std::int32_t{0x7fffffff} : ticks_between(now, records[id].prediction.until);
    }

    /// The shorter of both: ticks that count for the pair. None between two still objects.
    std::int32_t common_horizon(ProxyId first, ProxyId second, Tick now) const
    {
        const bool both_still = records[first].kind.still && records[second].kind.still;
        return both_still ? 0 : std::min(remaining(first, now), remaining(second, now));
    }

    /// A box that holds the envelope from `now` to its end.
    FloatBox swept_box(ProxyId id, Tick now) const
    {
        const Envelope current = outer_envelope(id, now);
        return FloatBox::around(records[id].kind.still ? current.at(0) : current.swept(remaining(id, now)));
    }

    /// The envelope of an object will soon be read.
    void prefetch(ProxyId id) const
    {
        ode_predictive_space::prefetch(&paths[id]);
        ode_predictive_space::prefetch(&records[id]);
        ode_predictive_space::prefetch(&generations[id]);
    }

    bool current(ProxyId id, Generation generation) const { return generations[id] == generation; }

    /// Rounding errors of the scene's coordinates, as a part of their size; 0 in double precision.
    double scene_rounding() const { return 8 * scene_epsilon_; }

    std::size_t bytes() const
    {
        return bytes_of(paths) + bytes_of(records) + bytes_of(stamps) + bytes_of(generations) + bytes_of(free_) +
               members_.bytes();
    }

private:
    void resize(std::size_t size)
    {
        resize_array(paths, size);
        resize_array(records, size);
        resize_array(stamps, size);
        members_.resize(size);
        resize_array(generations, size); // last: it tells the size
    }

    // Everything but the generation.
    void forget(ProxyId id)
    {
        paths[id] = PackedPath{};
        records[id] = ProxyRecord{};
        records[id].learned.history = no_history;
        stamps[id] = Stamp{};
    }

    // The bounding box that a scene computes from the centre is off by its rounding. In double precision that is a part of
    // rounding_per_size already.
    double rounding_of_scene(ProxyId id) const
    {
        if (scene_epsilon_ == 0)
            return 0;
        const double *centre = paths[id].position;
        const double radius = std::isfinite(records[id].prediction.radius) ? records[id].prediction.radius : 0;
        return scene_rounding() * (std::max({std::abs(centre[0]), std::abs(centre[1]), std::abs(centre[2])}) + radius);
    }

    Envelope from_now(ProxyId id, const Deviation &deviation, Tick now) const
    {
        const ProxyRecord::Prediction &box = records[id].prediction;
        const Envelope since{paths[id].path(), deviation, Vector3(box.low[0], box.low[1], box.low[2]),
                             Vector3(box.high[0], box.high[1], box.high[2]), box.radius};
        return records[id].kind.still ? since : since.advanced(ticks_between(paths[id].since, now));
    }

    double scene_epsilon_;
    IdSet members_;
    std::size_t count_ = 0;     // of members_
    std::vector<ProxyId> free_; // numbers, the next one last; has room for all
};
} // namespace ode_predictive_space

#endif
