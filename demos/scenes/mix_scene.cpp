#include "demos/scenes/mix_scene.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double volume_fraction = 0.04;
constexpr double density = 100;          // kg/m^3: an object weighs up to 0.4 kg
constexpr double slowest = 0.2;          // m/s
constexpr double fastest = 1;            // m/s
constexpr double time_to_recover = 0.2;  // seconds
constexpr double probe_radius = 0.1;     // metres
constexpr std::uint32_t probe_index = 0; // the probe is made first

haptics::HandPathSettings hand_settings(int objects)
{
    haptics::HandPathSettings settings;
    settings.scale = (mix_half_room(objects) - probe_radius) / (settings.half_workspace + settings.tremor);
    return settings;
}

/// Places in a lattice, shuffled: no two objects overlap at the start, where contacts would blast them apart.
std::vector<Vector3> free_places(int count, double half_room, haptics::Random &random)
{
    const int side = static_cast<int>(std::ceil(std::cbrt(count)));
    const double cell = 2 * half_room / side;
    const double play = std::max(0.0, cell / 2 - object_radius);
    std::vector<Vector3> places;
    for (int i = 0; i < side * side * side; ++i)
    {
        const int row = i / side % side;
        const int layer = i / side / side;
        const Vector3 number(i % side, row, layer);
        places.emplace_back(cell * (number + Vector3::Constant(0.5)) - Vector3::Constant(half_room) +
                            random.in_box(Vector3::Constant(play)));
    }
    for (std::size_t i = places.size() - 1; i > 0; --i)
        std::swap(places[i], places[random.index(i + 1)]);
    return places;
}
} // namespace

double mix_half_room(int objects)
{
    return std::max(half_room(objects, volume_fraction), 3 * object_radius);
}

MixScene::MixScene(const SceneSpec &spec, dSpaceID space)
    : ContactScene(space, usual_tick, spec.seed), hand_(hand_settings(spec.objects), spec.seed),
      probe_(spec.own_probe ? objects_.add_geom(dCreateSphere(space, probe_radius)) : nullptr)
{
    surface_.mode = dContactApprox1 | dContactBounce;
    surface_.mu = 0.2;
    surface_.bounce = 0.9;
    surface_.bounce_vel = 0.01;
    add_walls(Vector3::Constant(mix_half_room(spec.objects)), wall_thickness, true);
    haptics::Random random(spec.seed);
    fill(spec.objects, random);
}

void MixScene::fill(int count, haptics::Random &random)
{
    const std::vector<Vector3> places = free_places(count, mix_half_room(count), random);
    for (int i = 0; i < count; ++i)
    {
        // Shapes alternate in twos, so that half of each shape moves.
        const auto shape = static_cast<Shape>(i / 2 % 4);
        const Vector3 &place = places[static_cast<std::size_t>(i)];
        if (i % 2 == 0)
            objects_.add_still(shape, place, random.orientation());
        else
            add_floater(shape, place, random);
    }
}

void MixScene::add_floater(Shape shape, const Vector3 &position, haptics::Random &random)
{
    BodyState state;
    state.position = position;
    state.orientation = random.orientation();
    const double speed = random.uniform(slowest, fastest);
    state.velocity = speed * random.direction();
    state.angular_velocity = random.uniform(0, 3) * random.direction();
    const Object object = objects_.add_moving(shape, state, density);
    dMass mass;
    dBodyGetMass(object.body, &mass);
    floaters_.push_back({object.body, speed, mass.mass});
}

void MixScene::advance()
{
    ContactScene::advance();
    if (probe_ == nullptr)
        return;
    ++tick_;
    report_.position = hand_.position(tick_ * usual_tick);
    set_position(probe_, report_.position);
}

void MixScene::before_step()
{
    for (const Floater &floater : floaters_)
    {
        const Vector3 velocity = from_ode(dBodyGetLinearVel(floater.body));
        const double speed = std::max(velocity.norm(), 0.01 * floater.cruising_speed);
        const Vector3 force = floater.mass / time_to_recover * (floater.cruising_speed / speed - 1) * velocity;
        dBodyAddForce(floater.body, force.x(), force.y(), force.z());
    }
}

void MixScene::respond(const std::vector<IndexPair> &pairs)
{
    report_.touched.clear();
    ContactScene::respond(pairs);
    report_.force = force_.apply();
}

bool MixScene::take_contacts(const IndexPair &pair, const dContactGeom *contacts, int count)
{
    if (probe_ == nullptr || pair.first != probe_index)
        return false;
    report_.touched.push_back(pair.second);
    force_.touch(contacts, count, dGeomGetBody(objects_.geom(pair.second)));
    return true;
}
} // namespace ode_predictive_space::scenes
