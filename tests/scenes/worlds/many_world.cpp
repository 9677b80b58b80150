// One small world after the other, each with a space of its own and a short life.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"
#include "tests/scenes/worlds/worlds.h"

namespace ode_predictive_space::scenes
{
namespace
{
class ManyWorlds : public Scene
{
public:
    ManyWorlds(const SceneSpec &spec, dSpaceID model) : factory_(life_of_many(spec)), model_(model) { begin_life(); }
    ~ManyWorlds() override { end_life(); }

    void advance() override
    {
        if (age_ == ticks_of_life)
        {
            end_life();
            begin_life();
        }
        ++age_;
        scene_->advance();
    }
    void collide(dSpaceID, PairList &list) override { scene_->collide(space_, list); }
    void respond(const std::vector<IndexPair> &pairs) override { scene_->respond(pairs); }
    std::size_t contacts() const override { return scene_->contacts(); }
    bool moves_by_itself() const override { return false; }
    const ProbeReport *probe() const override { return nullptr; }
    const std::vector<dGeomID> &geoms() const override { return scene_->geoms(); }

private:
    void begin_life()
    {
        age_ = 0;
        space_ = make_space_like(model_, nullptr, factory_.bounds());
        scene_ = factory_.make(space_);
    }

    void end_life()
    {
        dSpaceSetCleanup(space_, 0);
        dSpaceDestroy(space_);
        scene_.reset();
    }

    SceneFactory factory_;
    dSpaceID model_;
    dSpaceID space_ = nullptr;
    std::unique_ptr<Scene> scene_;
    int age_ = 0;
};
} // namespace

SceneRecipe many_world(const SceneSpec &spec)
{
    const SceneFactory life = life_of_many(spec);
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<ManyWorlds>(made, space); },
            life.bounds(), life.tick_seconds()};
}

// The plane is one of its geoms.
SceneFactory life_of_many(const SceneSpec &spec)
{
    SceneSpec life = spec;
    life.objects = std::max(1, spec.objects - 1);
    return {life, floor_world(life, 0)};
}
} // namespace ode_predictive_space::scenes
