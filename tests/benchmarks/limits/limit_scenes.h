// Scenes far outside of what programs usually have: very many, very large, very near, very far.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_LIMITS_LIMIT_SCENES_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_LIMITS_LIMIT_SCENES_H

#include "demos/scenes/spaces.h"

#include <memory>
#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
/// Geoms in a space. Their motion is the same in every space and does not depend on the pairs.
class LimitScene
{
public:
    virtual ~LimitScene() = default;

    /// Make one tick of motion.
    virtual void advance() = 0;

    /// What a program does to find all pairs: one dSpaceCollide(), and more where there are nested spaces.
    ///
    /// @param callback not called with a space.
    virtual void collide(void *data, dNearCallback *callback);

    /// Destroy all geoms in the order that the scene is about; in most scenes that of creation.
    virtual void empty() = 0;

protected:
    explicit LimitScene(dSpaceID space) : space_(space) {}
    dSpaceID space() const { return space_; }

private:
    dSpaceID space_;
};

/// In the order in which they are measured.
const std::vector<std::string> &limit_scene_names();

/// One sentence on what is in a scene; n is the number of its objects.
std::string describe_limit_scene(const std::string &name);

/// The same scene for every space of these arguments. Each geom has a number (scenes::geom_index()).
///
/// @param kind of the space; nested spaces are of the same kind: predictive, simple, hash or sap.
/// @throws std::invalid_argument for a name that is not one of limit_scene_names(), or another kind.
std::unique_ptr<LimitScene> make_limit_scene(const std::string &name, int objects, scenes::SpaceKind kind,
                                             dSpaceID space);
} // namespace ode_predictive_space::benchmarks

#endif
