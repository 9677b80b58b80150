#include "demos/worlds/asking.h"

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double ray_length = 4;       // metres
constexpr double ray_turn = 1;         // rad/s
constexpr double smallest_asker = 0.1; // metres
constexpr double largest_asker = 0.3;  // metres
} // namespace

Askers::Askers(int first, double half_room, std::uint64_t seed)
{
    haptics::Random random(haptics::mix_bits(seed));
    for (int i = 0; i < asking_spheres; ++i)
    {
        hands_.push_back(
            {haptics::HandPath(hand_in(half_room), random.bits()), random.direction(), random.direction()});
        geoms_.push_back(dCreateSphere(nullptr, random.uniform(smallest_asker, largest_asker)));
    }
    for (int i = 0; i < asking_spheres; ++i)
        geoms_.push_back(dCreateRay(nullptr, ray_length));
    for (std::size_t i = 0; i < geoms_.size(); ++i)
        set_geom_index(geoms_[i], static_cast<std::uint32_t>(static_cast<std::size_t>(first) + i));
    for (std::size_t i = 0; i < hands_.size(); ++i)
        place(i);
}

Askers::~Askers()
{
    for (const dGeomID geom : geoms_)
        dGeomDestroy(geom);
}

void Askers::advance()
{
    ++tick_;
    for (std::size_t i = 0; i < hands_.size(); ++i)
        place(i);
}

void Askers::place(std::size_t number)
{
    Hand &hand = hands_[number];
    const double time = tick_ * usual_tick;
    const Vector3 position = hand.path.position(time);
    const Vector3 direction = Eigen::AngleAxisd(ray_turn * time, hand.axis) * hand.direction;
    set_position(geoms_[number], position);
    dGeomRaySet(geoms_[number + asking_spheres], position.x(), position.y(), position.z(), direction.x(), direction.y(),
                direction.z());
}
} // namespace ode_predictive_space::worlds
