// Every world moves to the last bit as it did when its line of motion_hashes.txt was written.

#include "tests/scenes/few_objects.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iomanip>
#include <iostream>
#include <set>
#include <sstream>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr int ticks = 210; // more than between two events of a world

class BitHash
{
public:
    template <typename Number> void add(const Number *numbers, int count)
    {
        const auto *bytes = reinterpret_cast<const unsigned char *>(numbers);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count) * sizeof(Number); ++i)
            value_ = (value_ ^ bytes[i]) * 0x100000001b3u;
    }
    void add(double number) { add(&number, 1); }

    std::string text() const
    {
        std::ostringstream text;
        text << std::hex << std::setw(16) << std::setfill('0') << value_;
        return text.str();
    }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Planes do not move, and some are not in the space.
void add_geoms(BitHash &hash, const std::vector<dGeomID> &geoms)
{
    for (const dGeomID geom : geoms)
    {
        if (geom == nullptr || dGeomGetClass(geom) == dPlaneClass)
            continue;
        dReal box[6];
        dGeomGetAABB(geom, box);
        hash.add(box, 6);
        hash.add(dGeomGetPosition(geom), 3);
        hash.add(dGeomGetRotation(geom), 12);
    }
}

template <typename Number> void add_pairs(BitHash &hash, const std::vector<std::pair<Number, Number>> &pairs)
{
    hash.add(static_cast<double>(pairs.size()));
    for (const auto &[first, second] : pairs)
    {
        hash.add(first);
        hash.add(second);
    }
}

std::string hash_of(const WorldSpec &spec)
{
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    const std::unique_ptr<World> world = WorldFactory(spec).make(space.get());
    BitHash hash;
    add_geoms(hash, world->geoms());
    for (int tick = 0; tick < ticks; ++tick)
    {
        PairList list;
        world->advance();
        world->collide(space.get(), &list, PairList::near);
        for (const dGeomID query : world->queries())
            dSpaceCollide2(query, reinterpret_cast<dGeomID>(space.get()), &list, &PairList::collect);
        std::vector<IndexPair> pairs = list.sorted();
        add_pairs(hash, pairs);
        add_geoms(hash, world->geoms());
        add_geoms(hash, world->queries());
        const auto asked = [&](const IndexPair &pair) { return pair.second >= world->geoms().size(); };
        pairs.erase(std::remove_if(pairs.begin(), pairs.end(), asked), pairs.end());
        world->respond(pairs);
        if (world_named(spec.name).group != Group::limit)
            hash.add(static_cast<double>(world->contacts()));
    }
    return hash.text();
}

void add_fall(BitHash &hash)
{
    const dWorldID world = dWorldCreate();
    dWorldSetGravity(world, 0, 0, -9.81);
    const dJointGroupID joints = dJointGroupCreate(0);
    const dBodyID body = dBodyCreate(world);
    const dGeomID box = dCreateBox(nullptr, 0.3, 0.2, 0.1), floor = dCreatePlane(nullptr, 0, 0, 1, 0);
    dGeomSetBody(box, body);
    dBodySetPosition(body, 0, 0, 0.4);
    dBodySetAngularVel(body, 1, 2, 3);
    dRandSetSeed(3);
    for (int tick = 0; tick < 300; ++tick)
    {
        dContact contacts[8]{};
        const int count = dCollide(box, floor, 8, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i)
        {
            contacts[i].surface.mu = 0.5;
            dJointAttach(dJointCreateContact(world, joints, &contacts[i]), body, nullptr);
        }
        dWorldQuickStep(world, 0.005);
        dJointGroupEmpty(joints);
    }
    add_geoms(hash, {box});
    dJointGroupDestroy(joints);
    dGeomDestroy(box);
    dGeomDestroy(floor);
    dWorldDestroy(world);
}

/// Other influences on motion: the mathematical library, ODE, and the order in which a compiler evaluates operands.
std::string fingerprint()
{
    BitHash hash;
    int order = 0;
    const auto next = [&order](int digit) {
        order = 10 * order + digit;
        return digit;
    };
    hash.add(next(1) * Vector3::Constant(next(2)).sum() + order);
    for (int i = 1; i < 2000; ++i)
    {
        const double x = 0.017 * i;
        for (const double y : {std::sin(x), std::cos(x), std::cbrt(x), std::sqrt(x), std::pow(x, 3.0)})
            hash.add(y);
    }
    add_fall(hash);
    return hash.text();
}

struct Line
{
    std::string name;
    WorldSpec spec;
};

std::ostream &operator<<(std::ostream &out, const Line &line)
{
    return out << line.name << ' ' << line.spec.objects << ' ' << line.spec.seed << ' ' << hash_of(line.spec);
}

std::vector<Line> lines()
{
    std::vector<Line> all = {{"gas_of_which_a_tenth_moves", {"gas", 100, 3, 0.1}},
                             {"mix_without_probe", {"mix", 100, 3, -1, false}}};
    for (const WorldEntry &world : all_worlds())
        all.push_back({world.name, {world.name, objects_of(world.name), world.group == Group::limit ? 1u : 3u}});
    return all;
}

TEST(MotionHashes, AreThoseOfTheTable)
{
    dInitODE();
    const std::string here = fingerprint();
    if (std::getenv("WRITE_MOTION_HASHES") != nullptr)
    {
        std::cout
            << "# world, objects, seed, hash of the motion of 210 ticks; written where this fingerprint was found:\n"
            << here << '\n';
        for (const Line &line : lines())
            std::cout << line << '\n';
        return;
    }
    std::ifstream table(MOTION_HASHES);
    std::string text;
    std::getline(table, text);
    std::getline(table, text);
    // Another mathematical library, ODE or compiler gives other numbers, but always the same ones.
    const bool is_known_here = text == here;
    std::set<std::string> expected, found;
    while (is_known_here && std::getline(table, text))
        expected.insert(text);
    const auto put_lines = [](std::set<std::string> &texts) {
        for (const Line &line : lines())
        {
            std::ostringstream one;
            one << line;
            texts.insert(one.str());
        }
    };
    put_lines(found);
    if (!is_known_here)
        put_lines(expected);
    EXPECT_EQ(found, expected);
}
} // namespace
} // namespace ode_predictive_space::worlds
