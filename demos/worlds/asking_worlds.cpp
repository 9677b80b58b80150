#include "demos/worlds/lists.h"
#include "ode_predictive_space/haptics/hand_path.h"

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double ray_length = 4;       // metres
constexpr double ray_turn = 1;         // rad/s
constexpr double smallest_asker = 0.1; // metres
constexpr double largest_asker = 0.3;  // metres

/// In no space, 20 spheres that follow hand paths, and a ray from each of them in a direction that turns slowly. The other
/// world has the room of gas; contacts that it may have are not followed.
class AskingWorld : public World
{
public:
    AskingWorld(const WorldSpec &spec, dSpaceID space, const char *other)
        : World(spec, nullptr),
          objects_of_other_(WorldFactory({other, spec.objects, spec.seed, spec.moving}).make(space))
    {
        haptics::HandPathSettings hand;
        hand.scale = half_gas_room(spec.objects, thin) / hand.half_workspace;
        haptics::Random random(haptics::mix_bits(spec.seed));
        for (int i = 0; i < asking_spheres; ++i)
        {
            hands_.push_back({haptics::HandPath(hand, random.bits()), random.direction(), random.direction()});
            askers_.push_back(dCreateSphere(nullptr, random.uniform(smallest_asker, largest_asker)));
        }
        for (int i = 0; i < asking_spheres; ++i)
            askers_.push_back(dCreateRay(nullptr, ray_length));
        for (std::size_t i = 0; i < askers_.size(); ++i)
            set_geom_index(askers_[i], static_cast<std::uint32_t>(static_cast<std::size_t>(spec.objects) + i));
        place_askers(0);
    }
    ~AskingWorld() override
    {
        for (const dGeomID asker : askers_)
            dGeomDestroy(asker);
    }

    void advance() override
    {
        objects_of_other_->advance();
        place_askers(++tick_);
    }
    const std::vector<dGeomID> &geoms() const override { return objects_of_other_->geoms(); }

    /// The spheres, then the rays.
    const std::vector<dGeomID> &queries() const override { return askers_; }

private:
    struct Hand
    {
        haptics::HandPath path;
        Vector3 axis;      ///< about which the ray turns
        Vector3 direction; ///< of the ray at the start
    };

    void place_askers(int tick)
    {
        const double time = tick * usual_tick;
        for (std::size_t i = 0; i < hands_.size(); ++i)
        {
            const Vector3 position = hands_[i].path.position(time);
            const Vector3 direction = Eigen::AngleAxisd(ray_turn * time, hands_[i].axis) * hands_[i].direction;
            set_position(askers_[i], position);
            dGeomRaySet(askers_[i + asking_spheres], position.x(), position.y(), position.z(), direction.x(),
                        direction.y(), direction.z());
        }
    }

    std::unique_ptr<World> objects_of_other_;
    std::vector<Hand> hands_;
    std::vector<dGeomID> askers_;
    int tick_ = 0;
};
} // namespace

std::vector<WorldEntry> asking_worlds()
{
    return {
        {Group::scene, "query", "gas, with 20 spheres and 20 rays that ask in each tick what is near them", 1000,
         usual_tick, gas_bounds(thin), made_of<AskingWorld>("gas")},
        {Group::stepped, "ask", "gas without dSpaceCollide(): 20 spheres ask in each tick what is near them", 1000,
         usual_tick, gas_bounds(thin), made_of<AskingWorld>("gas_stepped")},
    };
}
} // namespace ode_predictive_space::worlds
