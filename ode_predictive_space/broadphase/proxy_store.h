// What the broad phase knows of each object: its predicted path and envelope.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PROXY_STORE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PROXY_STORE_H

#include <cstddef>
#include <limits>
#include <vector>

#include "ode_predictive_space/broadphase/float_box.h"
#include "ode_predictive_space/broadphase/growth.h"
#include "ode_predictive_space/broadphase/prefetch.h"
#include "ode_predictive_space/broadphase/types.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// The hot half of a proxy: where its centre may be. One cache line, the only one that a check of the centre reads.
///
/// Velocity, acceleration and deviation are floats: the path is *defined* by the rounded values. What the deviation grows by
/// lies beside them as that of a fourth axis would: four floats are computed with at once.
struct alignas(64) PackedPath
{
    double position[3];
    float deviation_base; ///< a of R(t) = a + b t + c t^2
    Tick since;
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
    none,   ///< not predicted yet
    bounds, ///< its bounding box must lie within the envelope
    centre  ///< its centre must be within the deviation of the path, and its size must not have grown
};

/// Which part of the index an envelope is in.
enum class Shelf : std::uint8_t
{
    none,
    still,  ///< the tree of envelopes that do not move
    moving, ///< the tree of swept envelopes
    list    ///< the list of those that no tree can hold, and of all in a small scene
};

/// How the motion of an object is known, and who said so.
enum class Role : std::uint8_t
{
    environment,       ///< by default
    interactive,       ///< recognised: it moved without a body to tell its velocity
    fixed_environment, ///< as the program said
    fixed_interactive
};

inline bool is_interactive(Role role)
{
    return role == Role::interactive || role == Role::fixed_interactive;
}

/// The cold half of a proxy.
struct alignas(64) PackedBounds
{
    float low[3];  ///< bounds relative to the path
    float high[3]; ///< the same
    float radius;  ///< of a sphere around the path that holds the object; may be infinite
    Tick
        until; ///< tick of the next prediction, and last one of the envelope; still ones stay valid, and have none if it
               ///< is that of the last

    float last_velocity[3]; ///< of its body, in the program's unit, when it was last predicted
    float spread;           ///< growth of the deviation per tick, as adapted
    std::uint32_t horizon;  ///< in ticks, as adapted; 0 before the first prediction that is more than a guess
    std::uint32_t history;  ///< number of its history, or no_history
    Check check;
    Shelf shelf;
    Role role;
    bool still;             ///< path and deviation are constant: valid as long as it does not leave its envelope
    bool crowded;           ///< has or had near pairs: its tight bounds pay
    bool tight_bounds_last; ///< there are tighter ones than its bounding sphere's, and it hardly turns
    bool unbounded;         ///< no tree can hold its envelope: infinite, or not a number
    std::uint8_t mistrust;  ///< how often in a row its body's velocity did not explain its motion
};
static_assert(sizeof(PackedBounds) == 64, "one cache line");
constexpr std::uint32_t no_history = ~std::uint32_t{0};

/// What the notice of a move is judged by, beside the path.
struct Stamp
{
    float radius = -1;      ///< PackedBounds::radius of those with Check::centre, negative for the others
    std::uint32_t pose = 0; ///< digest of the pose at the last notice; 0 when that is not known
};

/// All proxies, by number. Plain arrays: each stage of the tick reads and writes the part that it is about.
struct ProxyStore
{
    std::vector<PackedPath> paths;
    std::vector<PackedBounds> bounds;
    std::vector<Stamp> stamps;
    std::vector<Generation> generations;

    std::size_t size() const { return generations.size(); }

    /// Makes room for one more, without a prediction.
    void grow()
    {
        const std::size_t count = size() + 1;
        ode_predictive_space::grow(paths, count);
        ode_predictive_space::grow(bounds, count);
        ode_predictive_space::grow(stamps, count);
        ode_predictive_space::grow(generations, count);
        forget(static_cast<ProxyId>(size() - 1));
    }

    /// Forgets everything about a proxy but its generation.
    void forget(ProxyId id)
    {
        paths[id] = PackedPath{};
        bounds[id] = PackedBounds{};
        bounds[id].history = no_history;
        stamps[id] = Stamp{};
    }

    /// Forgets how a proxy was predicted.
    void forget_prediction(ProxyId id)
    {
        bounds[id].check = Check::none;
        stamps[id] = Stamp{};
    }

    /// The envelope of a proxy, its time counted from `now` on.
    Envelope envelope(ProxyId id, Tick now) const { return from_now(id, deviation(id), now); }

    /// The same, larger by what rounding can do in verification, which computes in single precision how far path and
    /// deviation have come, and in a scene of single precision: where the object can be that has passed verification.
    Envelope outer_envelope(ProxyId id, Tick now) const
    {
        if (bounds[id].still)
            return from_now(id, rounded_by_scene(id, deviation(id)), now);
        constexpr double rounding = 8 * std::numeric_limits<float>::epsilon();
        const Path path = paths[id].path();
        Deviation outer = deviation(id);
        outer.a += rounding * outer.a;
        outer.b += rounding * (outer.b + path.velocity.lpNorm<Eigen::Infinity>());
        outer.c += rounding * (outer.c + path.acceleration.lpNorm<Eigen::Infinity>());
        return from_now(id, rounded_by_scene(id, outer), now);
    }

    /// Ticks from `now` on for which an envelope is valid; a very large number for still ones.
    std::int32_t remaining(ProxyId id, Tick now) const
    {
        return bounds[id].still ? std::int32_t{0x7fffffff} : ticks_between(now, bounds[id].until);
    }

    /// The shorter of both: ticks that count for the pair. None between two that are still.
    std::int32_t common_horizon(ProxyId first, ProxyId second, Tick now) const
    {
        const bool both_still = bounds[first].still && bounds[second].still;
        return both_still ? 0 : std::min(remaining(first, now), remaining(second, now));
    }

    /// A box that holds the envelope from `now` to its end.
    FloatBox swept_box(ProxyId id, Tick now) const
    {
        const Envelope current = outer_envelope(id, now);
        return FloatBox::around(bounds[id].still ? current.at(0) : current.swept(remaining(id, now)));
    }

    /// The envelope of a proxy will soon be asked for.
    void prefetch(ProxyId id) const
    {
        ode_predictive_space::prefetch(&paths[id]);
        ode_predictive_space::prefetch(&bounds[id]);
        ode_predictive_space::prefetch(&generations[id]);
    }

    bool current(ProxyId id, Generation generation) const { return generations[id] == generation; }

    std::size_t bytes() const
    {
        return paths.capacity() * sizeof(PackedPath) + bounds.capacity() * sizeof(PackedBounds) +
               stamps.capacity() * sizeof(Stamp) + generations.capacity() * sizeof(Generation);
    }

private:
    Deviation deviation(ProxyId id) const { return paths[id].deviation(); }

    // The bounding box that a scene computes from the centre is off by its rounding. In double precision that is a part of
    // rounding_per_size already. (What the path adds to the centre, outer_envelope() does for velocity and acceleration.)
    Deviation rounded_by_scene([[maybe_unused]] ProxyId id, Deviation deviation) const
    {
        if constexpr (sizeof(SceneReal) < sizeof(double))
        {
            constexpr double rounding = 8 * std::numeric_limits<SceneReal>::epsilon();
            const double *centre = paths[id].position;
            const double radius = std::isfinite(bounds[id].radius) ? bounds[id].radius : 0;
            deviation.a +=
                rounding * (std::max({std::abs(centre[0]), std::abs(centre[1]), std::abs(centre[2])}) + radius);
        }
        return deviation;
    }

    Envelope from_now(ProxyId id, const Deviation &deviation, Tick now) const
    {
        const PackedBounds &box = bounds[id];
        const Envelope since{paths[id].path(), deviation, Vector3(box.low[0], box.low[1], box.low[2]),
                             Vector3(box.high[0], box.high[1], box.high[2]), box.radius};
        return box.still ? since : since.advanced(ticks_between(paths[id].since, now));
    }
};
} // namespace ode_predictive_space

#endif
