// The paper's experiment: still and moving objects in a room, and a probe that a hand moves among them.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"
#include "ode_predictive_space/haptics/hand_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode_predictive_space::worlds
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

/// Half the side of the room inside its walls, in metres.
double half_side_of_mix(int objects)
{
    return std::max(half_room(objects, volume_fraction), 3 * object_radius);
}

haptics::HandPathSettings hand_settings(int objects)
{
    haptics::HandPathSettings settings;
    settings.scale = (half_side_of_mix(objects) - probe_radius) / (settings.half_workspace + settings.tremor);
    return settings;
}

/// Places in a lattice, shuffled: no two objects overlap at the start, where contacts would blast them apart.
std::vector<Vector3> places_in_lattice(int count, double half_room, haptics::Random &random)
{
    const int side = static_cast<int>(std::ceil(std::cbrt(count)));
    const double cell = 2 * half_room / side;
    const double play = std::max(0.0, cell / 2 - object_radius);
    std::vector<Vector3> places;
    for (int i = 0; i < side * side * side; ++i)
    {
        const Vector3 number(i % side, i / side % side, i / side / side);
        places.emplace_back(cell * (number + Vector3::Constant(0.5)) - Vector3::Constant(half_room) +
                            random.in_box(Vector3::Constant(play)));
    }
    for (std::size_t i = places.size() - 1; i > 0; --i)
        std::swap(places[i], places[random.index(i + 1)]);
    return places;
}

/// The penalty force of the paper: F = k d n for each touched object, d the depth of the deepest contact with it and n its
/// normal, towards the probe. Both each force and their sum are kept within the maximum; -F acts on the touched body. The values
/// are those of a PHANToM Desktop, with half of the stiffness that it can render.
class ProbeForce
{
public:
    /// Add the contacts with one object, made by dCollide() with the probe first. `body` may be 0.
    void touch(const dContactGeom *contacts, int count, dBodyID body)
    {
        if (count == 0)
            return;
        const dContactGeom &deepest = *std::max_element(
            contacts, contacts + count, [](const dContactGeom &a, const dContactGeom &b) { return a.depth < b.depth; });
        const double magnitude = std::min(stiffness * deepest.depth, max_force);
        pushes_.push_back({body, from_ode(deepest.pos), magnitude * from_ode(deepest.normal)});
    }

    /// Pushes the touched bodies and starts again. The sum is scaled, so the force on the person stays its opposite.
    void apply()
    {
        Vector3 total = Vector3::Zero();
        for (const Push &push : pushes_)
            total += push.force;
        const double share = std::min(1.0, max_force / total.norm());
        for (const Push &push : pushes_)
        {
            if (push.body == nullptr)
                continue;
            const Vector3 reaction = -share * push.force;
            dBodyAddForceAtPos(push.body, reaction.x(), reaction.y(), reaction.z(), push.point.x(), push.point.y(),
                               push.point.z());
        }
        pushes_.clear();
    }

private:
    static constexpr double stiffness = 500; ///< k, N/m
    static constexpr double max_force = 7.9; ///< N

    struct Push
    {
        dBodyID body; ///< 0: an object without a body
        Vector3 point;
        Vector3 force; ///< on the probe, N
    };

    std::vector<Push> pushes_;
};

/// Spheres, boxes, capsules and meshes in equal parts, without gravity. Half of them have no body and stay; the others float,
/// bounce, and are gently driven back to their initial speed, so that the motion does not die down. The probe, unless the
/// caller brings one, is the geom number 0: a sphere without a body, placed at the hand.
class MixWorld : public SteppedWorld
{
public:
    MixWorld(const WorldSpec &spec, dSpaceID space)
        : SteppedWorld(spec, space, usual_tick), hand_(hand_settings(spec.objects), spec.seed),
          probe_(spec.own_probe ? objects_.add_geom(dCreateSphere(space, probe_radius)) : nullptr)
    {
        let_bounce(0.2, 0.9, 0.01);
        const double half = half_side_of_mix(spec.objects);
        add_walls(Vector3::Constant(half), true);
        const std::vector<Vector3> places = places_in_lattice(spec.objects, half, random_);
        for (int i = 0; i < spec.objects; ++i)
        {
            // Shapes alternate in twos, so that half of each shape moves.
            const auto shape = static_cast<Shape>(i / 2 % 4);
            const Vector3 &place = places[static_cast<std::size_t>(i)];
            if (i % 2 == 0)
                objects_.add_still(shape, place, random_.orientation());
            else
                add_floater(shape, place);
        }
    }

    void advance() override
    {
        SteppedWorld::advance();
        if (probe_ == nullptr)
            return;
        set_position(probe_, hand_.position(++tick_ * usual_tick));
    }

    void respond(const std::vector<IndexPair> &pairs) override
    {
        SteppedWorld::respond(pairs);
        probe_force_.apply();
    }

private:
    struct Floater
    {
        dBodyID body;
        double cruising_speed; ///< m/s
    };

    void add_floater(Shape shape, const Vector3 &position)
    {
        BodyState state;
        state.position = position;
        state.orientation = random_.orientation();
        const double speed = random_.uniform(slowest, fastest);
        state.velocity = speed * random_.direction();
        state.angular_velocity = random_.uniform(0, 3) * random_.direction();
        floaters_.push_back({objects_.add_moving(shape, state, density), speed});
    }

    void before_step() override
    {
        for (const Floater &floater : floaters_)
        {
            const Vector3 velocity = from_ode(dBodyGetLinearVel(floater.body));
            const double speed = std::max(velocity.norm(), 0.01 * floater.cruising_speed);
            add_force(floater.body,
                      mass_of(floater.body) / time_to_recover * (floater.cruising_speed / speed - 1) * velocity);
        }
    }

    bool take_contacts(const IndexPair &pair, const dContactGeom *contacts, int count) override
    {
        if (probe_ == nullptr || pair.first != probe_index)
            return false;
        probe_force_.touch(contacts, count, dGeomGetBody(objects_.geom(pair.second)));
        return true;
    }

    haptics::HandPath hand_;
    dGeomID probe_; ///< null when the caller brings one
    ProbeForce probe_force_;
    std::vector<Floater> floaters_;
    int tick_ = 0;
};
} // namespace

std::vector<WorldEntry> mix_worlds()
{
    return {{Group::scene, "mix",
             "half still, half moving, real contacts, some triangle meshes, a probe on a hand's path that pushes them",
             1000, usual_tick, [](int objects) { return cube(half_side_of_mix(objects) + wall_thickness); },
             made_of<MixWorld>()}};
}
} // namespace ode_predictive_space::worlds
