// A few objects that are watched while the others are only scanned.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SCOUTS_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SCOUTS_H

#include <algorithm>
#include <vector>

#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/scan_policy.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// Tells whether objects move as could be predicted: whether each is where its last two positions lead.
class Scouts
{
public:
    /// Chooses among the members, evenly by number, the same ones for the same members.
    void choose(const IdSet &members)
    {
        const std::size_t stride = std::max<std::size_t>(1, members.size() / most);
        std::size_t rank = 0;
        scouts_.clear();
        members.for_each([&](ProxyId id) {
            if (rank++ % stride == 0 && scouts_.size() < most)
                scouts_.push_back({id, Vector3::Zero(), Vector3::Zero()});
        });
    }

    /// Looks where they are now.
    ///
    /// @return true when so many moved as predicted that predicting all would pay.
    template <typename Scene> bool calm(Scene &scene, const IdSet &members)
    {
        std::size_t strayed = 0;
        for (Scout &scout : scouts_)
        {
            if (!members.contains(scout.id))
                continue;
            const Box bounds = scene.bounds(scout.id);
            const Vector3 centre = bounds.center();
            const double tolerance = 0.1 * bounds.diagonal().minCoeff();
            const Vector3 expected = 2 * scout.last - scout.before;
            // False, too, when there is NaN in it.
            strayed += !((centre - expected).cwiseAbs().maxCoeff() <= tolerance);
            scout.before = scout.last;
            scout.last = centre;
        }
        return strayed * ScanPolicy::bad_part <= scouts_.size();
    }

    std::size_t bytes() const { return scouts_.capacity() * sizeof(Scout); }

private:
    static constexpr std::size_t most = 32;

    struct Scout
    {
        ProxyId id;
        Vector3 before;
        Vector3 last;
    };
    std::vector<Scout> scouts_;
};
} // namespace ode_predictive_space

#endif
