#include "demos/scenes/contact_scene.h"

#include <array>

namespace ode_predictive_space::scenes
{
namespace
{
// Walls touch one another at the edges of the room; these pairs do not count.
constexpr unsigned long wall_category = 2;
} // namespace

ContactScene::ContactScene(dSpaceID space, double step_seconds, std::uint64_t seed)
    : objects_(space), step_seconds_(step_seconds), random_seed_(haptics::mix_bits(seed) & 0xffffffffu),
      joints_(dJointGroupCreate(0))
{
    dWorldSetQuickStepNumIterations(objects_.world(), 20);
    dWorldSetAutoDisableFlag(objects_.world(), 0);
}

ContactScene::~ContactScene()
{
    dJointGroupDestroy(joints_);
}

void ContactScene::advance()
{
    before_step();
    // QuickStep draws from one stream for the whole process; other scenes must not disturb this one.
    dRandSetSeed(random_seed_);
    dWorldQuickStep(objects_.world(), step_seconds_);
    random_seed_ = dRandGetSeed();
    dJointGroupEmpty(joints_);
}

void ContactScene::respond(const std::vector<IndexPair> &pairs)
{
    contacts_ = 0;
    std::array<dContactGeom, max_contacts> found;
    for (const IndexPair &pair : pairs)
    {
        const dGeomID first = objects_.geom(pair.first);
        const dGeomID second = objects_.geom(pair.second);
        const int count = dCollide(first, second, max_contacts, found.data(), sizeof(dContactGeom));
        contacts_ += static_cast<std::size_t>(count);
        if (count == 0 || take_contacts(pair, found.data(), count))
            continue;
        const dBodyID first_body = dGeomGetBody(first);
        const dBodyID second_body = dGeomGetBody(second);
        for (int i = 0; i < count && (first_body != nullptr || second_body != nullptr); ++i)
        {
            dContact contact{};
            contact.surface = surface_;
            contact.geom = found[static_cast<std::size_t>(i)];
            dJointAttach(dJointCreateContact(objects_.world(), joints_, &contact), first_body, second_body);
        }
    }
}

bool ContactScene::take_contacts(const IndexPair &, const dContactGeom *, int)
{
    return false;
}

void ContactScene::add_walls(const Vector3 &half_room, double thickness, bool lid)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const double side : {-1.0, 1.0})
        {
            if (axis == 2 && side > 0 && !lid)
                continue;
            Vector3 half = half_room + Vector3::Constant(thickness);
            Vector3 centre = Vector3::Zero();
            centre[axis] = side * (half_room[axis] + thickness / 2);
            half[axis] = thickness / 2;
            const dGeomID wall = dCreateBox(objects_.space(), 2 * half.x(), 2 * half.y(), 2 * half.z());
            set_position(objects_.add_geom(wall), centre);
            dGeomSetCategoryBits(wall, wall_category);
            dGeomSetCollideBits(wall, ~wall_category);
        }
    }
}
} // namespace ode_predictive_space::scenes
