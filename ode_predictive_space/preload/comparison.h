#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_COMPARISON_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_COMPARISON_H

#include <set>
#include <vector>

#include "ode_predictive_space/preload/pairs.h"

namespace ode_predictive_space::preload
{
/// A pair that was not reported, or should not have been, or not again.
struct Difference
{
    const char *what; ///< "not reported", "reported although apart", "reported twice"
    Pair pair;
};

/// One collide: what a space reports against what it has to report.
class Comparison
{
public:
    /// @param expected found before the collide.
    /// @param contacts_only pairs may be left out that have no contact now, before the program's callbacks move anything.
    Comparison(const std::vector<Pair> &expected, bool contacts_only);

    /// A pair is reported; called before the program's callback is.
    void note(dGeomID first, dGeomID second);

    /// To be called once, after the collide. What a callback has disabled or given other bits is not missed.
    std::vector<Difference> finish();

private:
    std::set<Pair> expected_;
    std::set<Pair> required_; // of the expected ones, those that must not be left out
    std::set<Pair> reported_;
    std::vector<Difference> differences_;
};
} // namespace ode_predictive_space::preload

#endif
