// Spheres and rays that query the space.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_ASKING_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_ASKING_H

#include "demos/worlds/gas_room.h"
#include "ode_predictive_space/haptics/hand_path.h"

namespace ode_predictive_space::worlds
{
/// A hand that reaches through a cube.
inline haptics::HandPathSettings hand_in(double half_cube, double tremor = 0)
{
    haptics::HandPathSettings settings;
    settings.scale = half_cube / (settings.half_workspace + tremor);
    return settings;
}

/// In no space, 20 spheres that follow hand paths, and a ray from each of them in a direction that turns slowly.
class Askers
{
public:
    /// @param first number of the first one
    Askers(int first, double half_room, std::uint64_t seed);
    ~Askers();
    Askers(const Askers &) = delete;
    Askers &operator=(const Askers &) = delete;

    /// Make one tick.
    void advance();

    /// The spheres, then the rays.
    const std::vector<dGeomID> &geoms() const { return geoms_; }

private:
    struct Hand
    {
        haptics::HandPath path;
        Vector3 axis;      ///< about which the ray turns
        Vector3 direction; ///< of the ray at the start
    };

    void place(std::size_t number);

    std::vector<Hand> hands_;
    std::vector<dGeomID> geoms_;
    int tick_ = 0;
};

/// Askers in a thin world, whose contacts, if it has some, are not followed.
template <typename Base> class Asking : public Base
{
public:
    template <typename... Arguments>
    Asking(const WorldSpec &spec, dSpaceID space, Arguments... arguments)
        : Base(spec, space, arguments...), askers_(spec.objects, half_gas_room(spec.objects, thin), spec.seed)
    {}

    void advance() override
    {
        Base::advance();
        askers_.advance();
    }
    void respond(const std::vector<IndexPair> &) override {}
    bool moves_by_itself() const override { return true; }
    const std::vector<dGeomID> &queries() const override { return askers_.geoms(); }

private:
    Askers askers_;
};
} // namespace ode_predictive_space::worlds

#endif
