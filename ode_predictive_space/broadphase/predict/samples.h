// The last poses of the objects in forecast queries, from which their motion is derived.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_SAMPLES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_SAMPLES_H

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/prediction/track.h"

namespace ode_predictive_space
{
struct QueryTime
{
    Tick tick;                ///< tick of the present poses: the next one if something has moved since the last
    std::uint64_t collisions; ///< number of collisions of the space, with and without moves
};

/// Poses by object. An object is sampled from its first query until it rests; then only its last move is remembered.
class Samples
{
public:
    /// The track of an object, which is sampled from now on; null if the object rests.
    const Track *ask(Scene &scene, const ProxyStore &proxies, ProxyId id, const QueryTime &now);

    void sample(Scene &scene, const ProxyStore &proxies, Tick now);

    void forget(ProxyId id);
    std::size_t bytes() const;

private:
    struct Sampled
    {
        UpdateNumber moved;                   // Place::moved() at the newest pose
        std::optional<std::uint64_t> unmoved; // QueryTime::collisions at the first query since the last move
        Track track;
    };
    struct State
    {
        std::unique_ptr<Sampled> sampled;    // null if the object rests or was never asked about
        std::optional<UpdateNumber> resting; // Place::moved() of a resting object

        void rest()
        {
            resting = sampled->moved;
            sampled.reset();
        }
    };

    static bool renew(Scene &scene, const ProxyStore &proxies, ProxyId id, Sampled &sampled, Tick tick);

    std::vector<State> states_; // by object
};
} // namespace ode_predictive_space

#endif
