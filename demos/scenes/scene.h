// The scenes in which spaces are demonstrated, tested and measured.
//
// A scene gives the same motion in every space: run it once per space with the same specification, and every difference is
// due to the space.
//
//     SceneFactory factory({"gas", 1000, 1});
//     dSpaceID space = dPredictiveSpaceCreate(0);
//     std::unique_ptr<Scene> scene = factory.make(space);
//     PairList pairs;
//     for (...)
//     {
//         scene->advance();
//         pairs.clear();
//         dSpaceCollide(space, &pairs, &PairList::collect);
//         scene->respond(pairs.sorted());
//     }

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_SCENE_H

#include "demos/scenes/pair_list.h"
#include "demos/scenes/vector.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ode_predictive_space::scenes
{
/// Radius of the sphere around each object of a scene, metres.
constexpr double object_radius = 0.1;

/// Of the walls around a scene, metres.
constexpr double wall_thickness = 0.5;

/// Of scenes that do not step at a rate of their own, seconds.
constexpr double usual_tick = 0.001;

/// How many contacts are asked for of one pair.
constexpr int max_contacts = 8;

/// Which scene.
struct SceneSpec
{
    std::string name;       ///< one of scene_names()
    int objects = 100;      ///< n, >= 1; without walls and the probe
    std::uint64_t seed = 1; ///< of positions, motions, the hand; scenes of the same seed are the same
    double moving = -1;     ///< share of the objects that move, 0 … 1, in gas and churn; < 0: the scene's own, a half
    bool own_probe = true;  ///< of mix: false omits the probe; the caller brings one and handles its pairs
    bool settled = true;    ///< of pile: false lets it begin with its fall
};

/// A box that contains the scene.
struct SceneBounds
{
    Vector3 centre;
    Vector3 half_extent;
};

/// The probe of a scene in the last tick.
struct ProbeReport
{
    Vector3 position = Vector3::Zero();
    Vector3 force = Vector3::Zero();      ///< on the probe, N
    std::vector<std::uint32_t> touched{}; ///< numbers of the geoms that it touches, ascending
};

/// A running scene. The space of its geoms must outlive it.
class Scene
{
public:
    virtual ~Scene() = default;

    /// Make one tick of motion.
    virtual void advance() = 0;

    /// What a program calls in a tick for its pairs: dSpaceCollide(), unless the scene says otherwise.
    virtual void collide(dSpaceID space, PairList &list);

    /// Process the pairs that dSpaceCollide() reported after advance(), as PairList::sorted() gives them. Scenes with contacts
    /// need the pairs of every tick; the motion of the others does not depend on them.
    virtual void respond(const std::vector<IndexPair> &pairs) = 0;

    /// Contacts that the last respond() made.
    virtual std::size_t contacts() const = 0;

    /// Whether respond() may be omitted: the motion does not depend on the pairs.
    virtual bool moves_by_itself() const = 0;

    /// The probe in the last tick; null in a scene without one.
    virtual const ProbeReport *probe() const = 0;

    /// All geoms of the scene by their numbers; null for destroyed ones. (Not every space can enumerate its geoms.)
    virtual const std::vector<dGeomID> &geoms() const = 0;

    /// Geoms in no space, for a dSpaceCollide2() with the scene's space in each tick; none in most scenes. Their numbers follow
    /// those of the scene's geoms.
    virtual const std::vector<dGeomID> &queries() const;
};

/// The names of all scenes.
const std::vector<std::string> &scene_names();

/// One sentence on what happens in a scene.
std::string describe_scene(const std::string &name);

struct BodyState;

/// How to make a scene that is none of scene_names().
struct SceneRecipe
{
    std::function<std::unique_ptr<Scene>(const SceneSpec &, dSpaceID)> make;
    SceneBounds bounds;
    double tick_seconds = usual_tick;
};

/// Makes copies of one scene. Long preparations (a pile must settle) are made once, here.
class SceneFactory
{
public:
    /// @throws std::invalid_argument for a name that is not one of scene_names(), or for less than one object.
    explicit SceneFactory(const SceneSpec &spec);

    /// For a scene of the caller's own.
    SceneFactory(const SceneSpec &spec, SceneRecipe recipe);
    ~SceneFactory();
    SceneFactory(SceneFactory &&) noexcept;

    /// A new copy of the scene, its geoms in this space.
    std::unique_ptr<Scene> make(dSpaceID space) const;

    const SceneSpec &spec() const { return spec_; }

    /// The bounds of the scene, which a quadtree space needs in advance.
    SceneBounds bounds() const;

    /// The simulated time of one tick, in seconds.
    double tick_seconds() const;

private:
    SceneSpec spec_;
    SceneRecipe recipe_;             ///< for a scene of scene_names() it makes nothing
    std::vector<BodyState> settled_; ///< of a pile: the states of its bodies at rest
};
} // namespace ode_predictive_space::scenes

#endif
