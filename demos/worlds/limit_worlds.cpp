// Worlds far beyond those of usual programs: many planes, very large, very near, very far. No geom has a body.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr int moving_spheres = 100;
constexpr int ticks_per_period = 400;
constexpr double half_room_of_planes = 10; // metres
constexpr double half_room_of_spaces = 1;  // metres
constexpr double tiny_radius = 0.0005;     // metres
constexpr double huge_radius = 1e6 * object_radius;

/// Spheres, of which some oscillate, each about its own place.
class SpheresWorld : public ProgramWorld
{
public:
    void advance() override
    {
        const double share = std::sin(2 * pi * ++tick_ / ticks_per_period);
        for (const Oscillator &one : oscillators_)
            set_position(one.geom, one.place + share * one.reach);
    }
    void respond(const std::vector<IndexPair> &) override {}
    bool moves_by_itself() const override { return true; }

protected:
    SpheresWorld(const WorldSpec &spec, dSpaceID space) : ProgramWorld(spec, space, usual_tick) {}

    dGeomID add_sphere(dSpaceID space, const Vector3 &place, double radius = object_radius)
    {
        const dGeomID geom = objects_.add_geom(dCreateSphere(space, radius));
        set_position(geom, place);
        return geom;
    }

    void add_oscillating_sphere(dSpaceID space, double half_room)
    {
        const Vector3 place = random_.in_box(Vector3::Constant(half_room));
        let_oscillate(add_sphere(space, place), place, random_.direction());
    }

    void let_oscillate(dGeomID geom, const Vector3 &place, const Vector3 &reach)
    {
        oscillators_.push_back({geom, place, reach});
    }

private:
    struct Oscillator
    {
        dGeomID geom;
        Vector3 place, reach;
    };

    std::vector<Oscillator> oscillators_;
    int tick_ = 0;
};

class SpotWorld : public SpheresWorld
{
public:
    SpotWorld(const WorldSpec &spec, dSpaceID space) : SpheresWorld(spec, space)
    {
        for (int i = 0; i < spec.objects; ++i)
            add_sphere(space, Vector3::Zero());
    }

    void advance() override
    {
        for (const dGeomID geom : geoms())
            set_position(geom, random_.in_box(Vector3::Constant(0.01 * object_radius)));
    }
};

class PlanesWorld : public SpheresWorld
{
public:
    /// @param collide whether planes collide with one another. @param apart puts them into a simple space of their own.
    PlanesWorld(const WorldSpec &spec, dSpaceID space, bool collide, bool apart)
        : SpheresWorld(spec, space), apart_(apart ? dSimpleSpaceCreate(nullptr) : nullptr)
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 normal = random_.direction();
            const double distance = random_.uniform(-half_room_of_planes, half_room_of_planes);
            const dGeomID plane =
                dCreatePlane(apart_ != nullptr ? apart_.get() : space, normal.x(), normal.y(), normal.z(), distance);
            collide ? objects_.add_geom(plane) : objects_.add_scenery(plane);
        }
        for (int i = 0; i < moving_spheres; ++i)
            add_oscillating_sphere(space, half_room_of_planes);
    }
    ~PlanesWorld() override { objects_.clear(); } // before the space of the planes

    void collide(dSpaceID space, void *data, const NearCallbacks &near) override
    {
        SpheresWorld::collide(space, data, near);
        if (apart_ != nullptr)
            dSpaceCollide2(reinterpret_cast<dGeomID>(apart_.get()), reinterpret_cast<dGeomID>(space), data, near.geoms);
    }

private:
    OwnedSpace apart_;
};

/// Spaces within spaces, a hundred moving spheres in all.
class SpacesWorld : public SpheresWorld
{
public:
    /// @param in_each_other each space in the one before; otherwise all of them side by side in the outermost.
    SpacesWorld(const WorldSpec &spec, dSpaceID space, bool in_each_other) : SpheresWorld(spec, space)
    {
        dSpaceID parent = space;
        for (int i = 0; i < spec.objects; ++i)
        {
            nested_.push_back(add_space(cube(half_room_of_spaces), parent));
            dSpaceSetSublevel(nested_.back(), in_each_other ? i + 1 : 1);
            parent = in_each_other ? nested_.back() : parent;
        }
        for (int i = 0; i < moving_spheres; ++i)
            add_oscillating_sphere(nested_[static_cast<std::size_t>(i % spec.objects)], half_room_of_spaces);
    }
    ~SpacesWorld() override { objects_.clear(); }

    void collide(dSpaceID space, void *data, const NearCallbacks &near) override
    {
        dSpaceCollide(space, data, near.nested);
        for (const dSpaceID nested : nested_)
            dSpaceCollide(nested, data, near.nested);
    }

private:
    std::vector<dSpaceID> nested_;
};

/// Gas around whose middle a sphere drifts that is a million times as large as an object.
class HugeWorld : public SpheresWorld
{
public:
    HugeWorld(const WorldSpec &spec, dSpaceID space)
        : SpheresWorld(spec, space), gas_(WorldFactory({"gas", spec.objects, spec.seed}).make(space)),
          geoms_(gas_->geoms())
    {
        geoms_.push_back(add_sphere(space, Vector3::Zero(), huge_radius));
        set_geom_index(geoms_.back(), static_cast<std::uint32_t>(spec.objects));
        let_oscillate(geoms_.back(), Vector3::Zero(), Vector3::UnitX());
    }

    void advance() override
    {
        gas_->advance();
        SpheresWorld::advance();
    }
    const std::vector<dGeomID> &geoms() const override { return geoms_; }

private:
    std::unique_ptr<World> gas_;
    std::vector<dGeomID> geoms_; ///< with those of gas
};

/// Spheres of 1 mm around a place that is far from the origin, half of them moving by up to 0.5 mm per tick.
class FarWorld : public SpheresWorld
{
public:
    FarWorld(const WorldSpec &spec, dSpaceID space, double distance) : SpheresWorld(spec, space)
    {
        const Vector3 half = Vector3::Constant(tiny_radius / object_radius * half_room(spec.objects, thin));
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 place = Vector3::Constant(distance) + random_.in_box(half);
            const dGeomID geom = add_sphere(space, place, tiny_radius);
            if (i % 2 == 0)
                let_oscillate(geom, place, half.x() * random_.direction());
        }
    }
};

enum class Order
{
    first_to_last,
    last_to_first,
    random
};

class OrderWorld : public SpheresWorld
{
public:
    OrderWorld(const WorldSpec &spec, dSpaceID space, Order order) : SpheresWorld(spec, space), order_(order)
    {
        const Vector3 half = Vector3::Constant(half_room(spec.objects, thin));
        for (int i = 0; i < spec.objects; ++i)
            add_sphere(space, random_.in_box(half));
    }
    ~OrderWorld() override
    {
        std::vector<dGeomID> order = geoms();
        if (order_ == Order::last_to_first)
            std::reverse(order.begin(), order.end());
        for (std::size_t i = order.size(); order_ == Order::random && i > 1; --i)
            std::swap(order[i - 1], order[random_.index(i)]);
        for (const dGeomID geom : order)
            objects_.destroy(geom);
    }

private:
    Order order_;
};

template <typename Kind, typename... Arguments>
WorldEntry entry(const char *name, const char *text, const std::function<Bounds(int)> &bounds, Arguments... arguments)
{
    return {Group::limit, name, text, 1000, usual_tick, bounds, made_of<Kind>(arguments...)};
}

std::function<Bounds(int)> always(const Bounds &bounds)
{
    return [bounds](int) { return bounds; };
}

WorldEntry far(const char *name, const char *text, double distance)
{
    const auto bounds = [distance](int objects) -> Bounds {
        const double half = 2 * tiny_radius / object_radius * half_gas_room(objects, thin);
        return {Vector3::Constant(distance), Vector3::Constant(half)};
    };
    return entry<FarWorld>(name, text, bounds, distance);
}
} // namespace

std::vector<WorldEntry> limit_worlds()
{
    const auto planes = always(cube(half_room_of_planes + 1)), spaces = always(cube(half_room_of_spaces + 1));
    return {
        entry<SpotWorld>("spot", "n spheres on one spot, all of them trembling", always(cube(2 * object_radius))),
        entry<PlanesWorld>("planes", "n planes and 100 moving spheres; planes do not collide with one another", planes,
                           false, false),
        entry<PlanesWorld>("planes_all", "the same; planes collide with one another", planes, true, false),
        entry<PlanesWorld>("planes_apart", "the same; planes are in a simple space of their own", planes, true, true),
        entry<SpacesWorld>("spaces_in_spaces", "n spaces in one another, 100 moving spheres", spaces, true),
        entry<SpacesWorld>("spaces_side_by_side", "n spaces side by side in one space, 100 moving spheres", spaces,
                           false),
        entry<HugeWorld>("huge", "gas, and a moving sphere that is a million times as large as an object",
                         always(cube(2 * huge_radius))),
        far("close", "n spheres of 1 mm at the origin, half of them moving; what far is compared with", 0),
        far("away", "the same at coordinates of 1e6 m", 1e6),
        far("far", "the same at coordinates of 1e12 m", 1e12),
        entry<OrderWorld>("forwards", "n still spheres, destroyed from the first to the last", gas_bounds(thin),
                          Order::first_to_last),
        entry<OrderWorld>("backwards", "n still spheres, destroyed from the last to the first", gas_bounds(thin),
                          Order::last_to_first),
        entry<OrderWorld>("shuffled", "n still spheres, destroyed in random order", gas_bounds(thin), Order::random),
    };
}
} // namespace ode_predictive_space::worlds
