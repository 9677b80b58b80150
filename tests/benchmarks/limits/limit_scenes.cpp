#include "tests/benchmarks/limits/limit_scenes.h"

#include "demos/scenes/scene_objects.h"
#include "ode_predictive_space/haptics/device/random.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

constexpr std::uint64_t seed = 1;

/// Calls back for the pairs of geoms in nested spaces, too.
struct Descent
{
    static void near(void *self, dGeomID first, dGeomID second)
    {
        const Descent &descent = *static_cast<Descent *>(self);
        if (dGeomIsSpace(first) != 0 || dGeomIsSpace(second) != 0)
        {
            dSpaceCollide2(first, second, self, &near);
        }
        else
        {
            descent.callback(descent.data, first, second);
        }
    }

    void *data;
    dNearCallback *callback;
};

/// A scene of the scene library.
class GasLimit : public LimitScene
{
public:
    GasLimit(int objects, dSpaceID space) : LimitScene(space), scene_(SceneFactory({"gas", objects, seed}).make(space))
    {}

    void advance() override { scene_->advance(); }
    void empty() override { scene_.reset(); }

private:
    std::unique_ptr<Scene> scene_;
};

/// Geoms without bodies.
class BareScene : public LimitScene
{
public:
    ~BareScene() override { BareScene::empty(); }

    void empty() override
    {
        for (const dGeomID geom : geoms_)
        {
            dGeomDestroy(geom);
        }
        geoms_.clear();
    }

protected:
    explicit BareScene(dSpaceID space) : LimitScene(space), random_(seed) {}

    dGeomID add(dGeomID geom, const Vector3 &position = Vector3::Zero())
    {
        set_geom_index(geom, static_cast<std::uint32_t>(geoms_.size()));
        if (dGeomGetClass(geom) != dPlaneClass)
        {
            set_position(geom, position);
        }
        geoms_.push_back(geom);
        return geom;
    }

    haptics::Random random_;
    std::vector<dGeomID> geoms_; ///< in the order in which they are destroyed
};

/// Spheres that all overlap.
class SpotScene : public BareScene
{
public:
    SpotScene(int objects, dSpaceID space) : BareScene(space)
    {
        for (int i = 0; i < objects; ++i)
        {
            add(dCreateSphere(space, object_radius));
        }
    }

    void advance() override
    {
        for (const dGeomID geom : geoms_)
        {
            set_position(geom, random_.in_box(Vector3::Constant(0.01 * object_radius)));
        }
    }
};

/// Spheres that oscillate, each about its own place.
class Oscillators
{
public:
    void add(dGeomID geom, const Vector3 &place, const Vector3 &reach) { all_.push_back({geom, place, reach}); }

    void advance()
    {
        const double share = std::sin(2 * pi * ++tick_ / ticks_per_period);
        for (const Oscillator &one : all_)
        {
            set_position(one.geom, one.place + share * one.reach);
        }
    }

private:
    static constexpr int ticks_per_period = 400;

    struct Oscillator
    {
        dGeomID geom;
        Vector3 place, reach;
    };

    std::vector<Oscillator> all_;
    int tick_ = 0;
};

enum class Planes
{
    apart_by_bits, ///< they do not collide with one another
    with_each_other,
    in_another_space ///< a simple one, which is collided with the one that is measured
};

/// Planes in all directions among a hundred moving spheres.
class PlanesScene : public BareScene
{
public:
    PlanesScene(int planes, Planes which, dSpaceID space)
        : BareScene(space), apart_(which == Planes::in_another_space ? dSimpleSpaceCreate(nullptr) : nullptr)
    {
        for (int i = 0; i < planes; ++i)
        {
            const dGeomID plane = add_plane(apart_ != nullptr ? apart_.get() : space);
            if (which == Planes::apart_by_bits)
            {
                dGeomSetCategoryBits(plane, plane_category);
                dGeomSetCollideBits(plane, ~plane_category);
            }
        }
        for (int i = 0; i < spheres; ++i)
        {
            const Vector3 place = random_.in_box(Vector3::Constant(room));
            movers_.add(add(dCreateSphere(space, object_radius), place), place, random_.direction());
        }
    }

    // Before the space of the planes is destroyed.
    ~PlanesScene() override { BareScene::empty(); }

    void advance() override { movers_.advance(); }

    void collide(void *data, dNearCallback *callback) override
    {
        LimitScene::collide(data, callback);
        if (apart_ != nullptr)
        {
            dSpaceCollide2(reinterpret_cast<dGeomID>(apart_.get()), reinterpret_cast<dGeomID>(space()), data, callback);
        }
    }

private:
    static constexpr double room = 10; ///< metres
    static constexpr int spheres = 100;
    static constexpr unsigned long plane_category = 2;

    dGeomID add_plane(dSpaceID space)
    {
        const Vector3 normal = random_.direction();
        return add(dCreatePlane(space, normal.x(), normal.y(), normal.z(), random_.uniform(-room, room)));
    }

    OwnedSpace apart_;
    Oscillators movers_;
};

dSpaceID make_nested(SpaceKind kind, dSpaceID parent)
{
    switch (kind)
    {
    case SpaceKind::predictive:
        return dPredictiveSpaceCreate(parent);
    case SpaceKind::simple:
        return dSimpleSpaceCreate(parent);
    case SpaceKind::hash:
        return dHashSpaceCreate(parent);
    case SpaceKind::sweep_and_prune:
        return dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ);
    default:
        throw std::invalid_argument("no nested spaces of this kind");
    }
}

/// Spaces within spaces, a hundred moving spheres in all.
class NestedScene : public BareScene
{
public:
    /// @param in_each_other each space in the one before; otherwise all of them side by side in the outermost.
    NestedScene(int count, bool in_each_other, SpaceKind kind, dSpaceID space) : BareScene(space)
    {
        dSpaceID parent = space;
        for (int i = 0; i < count; ++i)
        {
            const dSpaceID nested = make_nested(kind, parent);
            dSpaceSetSublevel(nested, in_each_other ? i + 1 : 1);
            nested_.push_back(nested);
            parent = in_each_other ? nested : parent;
        }
        for (int i = 0; i < spheres; ++i)
        {
            const Vector3 place = random_.in_box(Vector3::Constant(room));
            const dSpaceID home = nested_[static_cast<std::size_t>(i % count)];
            movers_.add(add(dCreateSphere(home, object_radius), place), place, random_.direction());
        }
    }

    ~NestedScene() override { NestedScene::empty(); }

    void advance() override { movers_.advance(); }

    void collide(void *data, dNearCallback *callback) override
    {
        Descent descent{data, callback};
        dSpaceCollide(space(), &descent, &Descent::near);
        for (const dSpaceID nested : nested_)
        {
            dSpaceCollide(nested, &descent, &Descent::near);
        }
    }

    void empty() override
    {
        BareScene::empty();
        std::for_each(nested_.rbegin(), nested_.rend(), &dSpaceDestroy);
        nested_.clear();
    }

private:
    static constexpr double room = 1; ///< metres
    static constexpr int spheres = 100;

    std::vector<dSpaceID> nested_;
    Oscillators movers_;
};

/// Gas around whose middle a sphere drifts that is a million times as large as an object.
class HugeScene : public BareScene
{
public:
    HugeScene(int objects, dSpaceID space) : BareScene(space), gas_(objects, space)
    {
        movers_.add(add(dCreateSphere(space, 1e6 * object_radius)), Vector3::Zero(), Vector3::UnitX());
        set_geom_index(geoms_.front(), static_cast<std::uint32_t>(objects));
    }

    void advance() override
    {
        gas_.advance();
        movers_.advance();
    }

    void empty() override
    {
        gas_.empty();
        BareScene::empty();
    }

private:
    GasLimit gas_;
    Oscillators movers_;
};

/// Spheres of 1 mm around a place that is far from the origin, half of them moving by up to 0.5 mm per tick.
class FarScene : public BareScene
{
public:
    FarScene(int objects, double distance, dSpaceID space) : BareScene(space)
    {
        constexpr double radius = 0.0005; // metres
        const Vector3 half = Vector3::Constant(radius / object_radius * half_room(objects, 0.01));
        for (int i = 0; i < objects; ++i)
        {
            const Vector3 place = Vector3::Constant(distance) + random_.in_box(half);
            const dGeomID geom = add(dCreateSphere(space, radius), place);
            if (i % 2 == 0)
            {
                movers_.add(geom, place, half.x() * random_.direction());
            }
        }
    }

    void advance() override { movers_.advance(); }

private:
    Oscillators movers_;
};

enum class Order
{
    first_to_last,
    last_to_first,
    random
};

/// Still spheres that are destroyed in some order.
class OrderScene : public BareScene
{
public:
    OrderScene(int objects, Order order, dSpaceID space) : BareScene(space), order_(order)
    {
        const Vector3 half = Vector3::Constant(half_room(objects, 0.01));
        for (int i = 0; i < objects; ++i)
        {
            add(dCreateSphere(space, object_radius), random_.in_box(half));
        }
    }

    void advance() override {}

    void empty() override
    {
        if (order_ == Order::last_to_first)
        {
            std::reverse(geoms_.begin(), geoms_.end());
        }
        for (std::size_t i = geoms_.size(); order_ == Order::random && i > 1; --i)
        {
            std::swap(geoms_[i - 1], geoms_[random_.index(i)]);
        }
        BareScene::empty();
    }

private:
    Order order_;
};

struct Description
{
    const char *name;
    const char *text;
    std::unique_ptr<LimitScene> (*make)(int objects, SpaceKind kind, dSpaceID space);
};

template <typename Kind, typename... Arguments> std::unique_ptr<LimitScene> make(Arguments... arguments)
{
    return std::make_unique<Kind>(arguments...);
}

constexpr double far_away = 1e12; // metres
constexpr double away = 1e6;      // metres

const Description descriptions[] = {
    {"many", "gas: n objects, half of them moving at up to 1 mm per tick",
     [](int n, SpaceKind, dSpaceID space) { return make<GasLimit>(n, space); }},
    {"spot", "n spheres on one spot, all of them trembling",
     [](int n, SpaceKind, dSpaceID space) { return make<SpotScene>(n, space); }},
    {"planes", "n planes and 100 moving spheres; planes do not collide with one another",
     [](int n, SpaceKind, dSpaceID space) { return make<PlanesScene>(n, Planes::apart_by_bits, space); }},
    {"planes-all", "the same; planes collide with one another",
     [](int n, SpaceKind, dSpaceID space) { return make<PlanesScene>(n, Planes::with_each_other, space); }},
    {"planes-apart", "the same; planes are in a simple space of their own",
     [](int n, SpaceKind, dSpaceID space) { return make<PlanesScene>(n, Planes::in_another_space, space); }},
    {"nested", "n spaces in one another, 100 moving spheres",
     [](int n, SpaceKind kind, dSpaceID space) { return make<NestedScene>(n, true, kind, space); }},
    {"beside", "n spaces side by side in one space, 100 moving spheres",
     [](int n, SpaceKind kind, dSpaceID space) { return make<NestedScene>(n, false, kind, space); }},
    {"huge", "gas, and a moving sphere that is a million times as large as an object",
     [](int n, SpaceKind, dSpaceID space) { return make<HugeScene>(n, space); }},
    {"close", "n spheres of 1 mm at the origin, half of them moving; what far is compared with",
     [](int n, SpaceKind, dSpaceID space) { return make<FarScene>(n, 0.0, space); }},
    {"away", "the same at coordinates of 1e6 m",
     [](int n, SpaceKind, dSpaceID space) { return make<FarScene>(n, away, space); }},
    {"far", "the same at coordinates of 1e12 m",
     [](int n, SpaceKind, dSpaceID space) { return make<FarScene>(n, far_away, space); }},
    {"forwards", "n still spheres, destroyed from the first to the last",
     [](int n, SpaceKind, dSpaceID space) { return make<OrderScene>(n, Order::first_to_last, space); }},
    {"backwards", "n still spheres, destroyed from the last to the first",
     [](int n, SpaceKind, dSpaceID space) { return make<OrderScene>(n, Order::last_to_first, space); }},
    {"shuffled", "n still spheres, destroyed in random order",
     [](int n, SpaceKind, dSpaceID space) { return make<OrderScene>(n, Order::random, space); }},
};

const Description &description_of(const std::string &name)
{
    for (const Description &description : descriptions)
    {
        if (name == description.name)
        {
            return description;
        }
    }
    throw std::invalid_argument("there is no limit named \"" + name + "\"");
}
} // namespace

void LimitScene::collide(void *data, dNearCallback *callback)
{
    dSpaceCollide(space_, data, callback);
}

const std::vector<std::string> &limit_scene_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        for (const Description &description : descriptions)
        {
            result.emplace_back(description.name);
        }
        return result;
    }();
    return names;
}

std::string describe_limit_scene(const std::string &name)
{
    return description_of(name).text;
}

std::unique_ptr<LimitScene> make_limit_scene(const std::string &name, int objects, SpaceKind kind, dSpaceID space)
{
    return description_of(name).make(objects, kind, space);
}
} // namespace ode_predictive_space::benchmarks
