// Spheres and boxes that fall into a pit and stay there.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double heap_step = 0.005;
constexpr double spacing = 0.3;           // metres
constexpr double half_height_of_heap = 5; // of the pit, metres

int columns(int objects)
{
    return static_cast<int>(std::ceil(std::sqrt(objects / 10.0)));
}

double half_side_of_heap(int objects)
{
    return spacing / 2 * columns(objects) + spacing;
}

class HeapWorld : public WorldScene
{
public:
    HeapWorld(const SceneSpec &spec, dSpaceID space, double variation) : WorldScene(spec, space, heap_step)
    {
        vary_steps(variation);
        surface_.mode = dContactApprox1;
        surface_.mu = 0.5;
        add_walls({half_side_of_heap(spec.objects), half_side_of_heap(spec.objects), half_height_of_heap}, 0.5, false);
        const int side = columns(spec.objects);
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 cell(i % side - 0.5 * (side - 1), i / side % side - 0.5 * (side - 1), i / side / side);
            BodyState state;
            state.position = spacing * cell + random_.in_box({0.03, 0.03, 0});
            state.position.z() += 0.15 - half_height_of_heap;
            add_body(objects_, i % 2 == 0 ? dCreateSphere(space, 0.1) : dCreateBox(space, 0.2, 0.2, 0.2), 1, state);
        }
    }
};
} // namespace

SceneRecipe heap_world(const SceneSpec &spec, double variation)
{
    const double half = half_side_of_heap(spec.objects) + 0.5;
    return {[variation](const SceneSpec &made, dSpaceID space) {
                return std::make_unique<HeapWorld>(made, space, variation);
            },
            {Vector3::Zero(), {half, half, half_height_of_heap + 0.5}},
            heap_step};
}
} // namespace ode_predictive_space::scenes
