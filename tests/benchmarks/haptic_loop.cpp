#include "tests/benchmarks/haptic_loop.h"

#include "demos/worlds/objects.h"
#include "demos/worlds/world.h"
#include "ode_predictive_space/haptics/device/random.h"

#include <algorithm>
#include <array>
#include <ctime>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace ode_predictive_space::worlds;

constexpr double tick_seconds = 0.001;
constexpr double loop_probe_radius = 0.2;       // metres
constexpr double half_workspace = 1;            // in the scene, metres
constexpr double fastest_of_loop = 1;           // m/s, as in gas
constexpr double fastest_loop_spin = 5;         // rad/s, likewise
constexpr std::uint32_t probe_index = ~0u >> 1; // greater than all others

double microseconds_of_this_thread()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

haptics::HandPathSettings hand_settings()
{
    haptics::HandPathSettings settings;
    settings.scale = half_workspace / settings.half_workspace;
    return settings;
}

/// Gas whose moving objects are free bodies in a world that is stepped; what leaves the room is sent back.
class SteppedGas : public World
{
public:
    SteppedGas(const WorldSpec &spec, dSpaceID space)
        : World(spec, space), half_room_(WorldFactory(spec).bounds().half_extent.x() - object_radius)
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            const auto shape = static_cast<Shape>(i / 2 % 3);
            BodyState state;
            state.position = random_.in_box(Vector3::Constant(half_room_));
            state.orientation = random_.orientation();
            state.velocity = random_.uniform(0, fastest_of_loop) * random_.direction();
            state.angular_velocity = random_.uniform(0, fastest_loop_spin) * random_.direction();
            if (i % 2 == 0)
            {
                objects_.add_still(shape, state.position, state.orientation);
            }
            else
            {
                bodies_.push_back(objects_.add_moving(shape, state, 1000));
            }
        }
        dWorldSetAutoDisableFlag(objects_.world(), 0);
    }

    void advance() override
    {
        dWorldQuickStep(objects_.world(), tick_seconds);
        for (const dBodyID body : bodies_)
        {
            send_back(body);
        }
    }

private:
    void send_back(dBodyID body) const
    {
        const dReal *position = dBodyGetPosition(body);
        Vector3 velocity = from_ode(dBodyGetLinearVel(body));
        for (int axis = 0; axis < 3; ++axis)
        {
            if (std::abs(position[axis]) > half_room_ && position[axis] * velocity[axis] > 0)
            {
                velocity[axis] = -velocity[axis];
                dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
            }
        }
    }

    double half_room_;
    std::vector<dBodyID> bodies_;
};

std::unique_ptr<World> make_objects(const WorldSpec &spec, dSpaceID space, HapticTick tick)
{
    if (tick == HapticTick::stepped)
    {
        return std::make_unique<SteppedGas>(spec, space);
    }
    return WorldFactory(spec).make(space);
}
} // namespace

std::string haptic_tick_name(HapticTick tick)
{
    switch (tick)
    {
    case HapticTick::kinematic:
        return "kinematic";
    case HapticTick::stepped:
        return "quickstep";
    case HapticTick::collide:
        break;
    }
    return "collide";
}

HapticLoop::HapticLoop(SpaceKind kind, int objects, std::uint64_t seed, HapticTick tick)
    : space_(make_space(kind, WorldFactory({"gas", objects, seed}))),
      objects_(make_objects({"gas", objects, seed}, space_.get(), tick)), content_(tick), hand_(hand_settings(), seed),
      probe_(dCreateSphere(space_.get(), loop_probe_radius))
{
    set_geom_index(probe_, probe_index);
    set_position(probe_, hand_.position(0));
}

HapticLoop::~HapticLoop()
{
    dGeomDestroy(probe_);
}

double HapticLoop::tick()
{
    ++ticks_;
    if (content_ == HapticTick::collide)
    {
        objects_->advance();
    }
    const double start = microseconds_of_this_thread();
    if (content_ != HapticTick::collide)
    {
        objects_->advance();
    }
    read_device();
    touched_.clear();
    dSpaceCollide(space_.get(), this, &near);
    feel();
    return microseconds_of_this_thread() - start;
}

void HapticLoop::read_device()
{
    set_position(probe_, hand_.position(ticks_ * tick_seconds));
}

void HapticLoop::near(void *loop, dGeomID first, dGeomID second)
{
    auto &self = *static_cast<HapticLoop *>(loop);
    if (first == self.probe_ || second == self.probe_)
    {
        self.touched_.push_back(first == self.probe_ ? second : first);
    }
}

void HapticLoop::feel()
{
    constexpr int most_contacts = 8;
    std::array<dContactGeom, most_contacts> contacts;
    // In an order that does not depend on the space: a sum of forces does, in its last digit.
    std::sort(touched_.begin(), touched_.end(), [](dGeomID a, dGeomID b) { return geom_index(a) < geom_index(b); });
    for (const dGeomID geom : touched_)
    {
        const int count = dCollide(probe_, geom, most_contacts, contacts.data(), sizeof(dContactGeom));
        force_.touch(contacts.data(), count, dGeomGetBody(geom));
    }
    const double force = force_.apply().norm();
    force_sum_ += force;
    touches_ += force > 0 ? 1 : 0;
}
} // namespace ode_predictive_space::benchmarks
