#include "demos/scenes/query_scene.h"

#include "demos/scenes/kinematic_scenes.h"
#include "ode_predictive_space/haptics/device/random.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double ray_length = 4;       // metres
constexpr double ray_turn = 1;         // rad/s
constexpr double smallest_probe = 0.1; // metres
constexpr double largest_probe = 0.3;  // metres

haptics::HandPathSettings hand_settings(double half_room)
{
    haptics::HandPathSettings settings;
    settings.scale = half_room / settings.half_workspace;
    return settings;
}

SceneSpec gas_of(SceneSpec spec)
{
    spec.name = "gas";
    return spec;
}
} // namespace

QueryScene::QueryScene(const SceneSpec &spec, dSpaceID space)
    : QueryScene(spec, make_kinematic_scene(gas_of(spec), space))
{}

QueryScene::QueryScene(const SceneSpec &spec, std::unique_ptr<Scene> objects) : objects_(std::move(objects))
{
    const haptics::HandPathSettings settings = hand_settings(kinematic_half_room("gas", spec.objects));
    haptics::Random random(haptics::mix_bits(spec.seed));
    for (int i = 0; i < probes; ++i)
    {
        hands_.push_back({haptics::HandPath(settings, random.bits()), random.direction(), random.direction()});
        queries_.push_back(dCreateSphere(nullptr, random.uniform(smallest_probe, largest_probe)));
    }
    for (int i = 0; i < probes; ++i)
        queries_.push_back(dCreateRay(nullptr, ray_length));
    for (std::size_t i = 0; i < queries_.size(); ++i)
        set_geom_index(queries_[i], static_cast<std::uint32_t>(static_cast<std::size_t>(spec.objects) + i));
    for (std::size_t i = 0; i < hands_.size(); ++i)
        place(i);
}

QueryScene::~QueryScene()
{
    for (const dGeomID geom : queries_)
        dGeomDestroy(geom);
}

void QueryScene::advance()
{
    objects_->advance();
    ++tick_;
    for (std::size_t i = 0; i < hands_.size(); ++i)
        place(i);
}

void QueryScene::place(std::size_t number)
{
    Hand &hand = hands_[number];
    const double time = tick_ * usual_tick;
    const Vector3 position = hand.path.position(time);
    const Vector3 direction = Eigen::AngleAxisd(ray_turn * time, hand.axis) * hand.direction;
    set_position(queries_[number], position);
    dGeomRaySet(queries_[number + probes], position.x(), position.y(), position.z(), direction.x(), direction.y(),
                direction.z());
}
} // namespace ode_predictive_space::scenes
