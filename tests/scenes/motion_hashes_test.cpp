// Every world moves as it did when its line of motion_hashes.txt was written: to the last bit.

#include "demos/scenes/scene_run.h"
#include "tests/benchmarks/limits/limit_scenes.h"
#include "tests/benchmarks/stepped/stepped_scenes.h"
#include "tests/scenes/worlds/worlds.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr int ticks = 210; // more than between two events of the worlds that have some
constexpr std::uint64_t seed = 3;

/// FNV-1a of the bits of numbers.
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

std::vector<dGeomID> geoms_in(dSpaceID space)
{
    std::vector<dGeomID> geoms;
    for (int i = 0; i < dSpaceGetNumGeoms(space); ++i)
    {
        const dGeomID geom = dSpaceGetGeom(space, i);
        if (dGeomIsSpace(geom) != 0)
        {
            const std::vector<dGeomID> inside = geoms_in(reinterpret_cast<dSpaceID>(geom));
            geoms.insert(geoms.end(), inside.begin(), inside.end());
        }
        else
            geoms.push_back(geom);
    }
    std::stable_sort(geoms.begin(), geoms.end(), [](dGeomID a, dGeomID b) { return geom_index(a) < geom_index(b); });
    return geoms;
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

std::string hash_of(Scene &scene, dSpaceID space)
{
    BitHash hash;
    add_geoms(hash, scene.geoms());
    for (int tick = 0; tick < ticks; ++tick)
    {
        PairList list;
        scene.advance();
        scene.collide(space, list);
        for (const dGeomID query : scene.queries())
            dSpaceCollide2(query, reinterpret_cast<dGeomID>(space), &list, &PairList::collect);
        const std::vector<IndexPair> pairs = list.sorted();
        add_pairs(hash, pairs);
        add_geoms(hash, scene.geoms());
        add_geoms(hash, scene.queries());
        std::vector<IndexPair> of_scene;
        for (const IndexPair &pair : pairs)
        {
            if (pair.second < scene.geoms().size())
                of_scene.push_back(pair);
        }
        scene.respond(of_scene);
        hash.add(static_cast<double>(scene.contacts()));
        if (scene.probe() != nullptr)
            hash.add(scene.probe()->force.data(), 3);
    }
    return hash.text();
}

std::string hash_of_factory(const SceneFactory &factory)
{
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    return hash_of(*factory.make(space.get()), space.get());
}

std::string hash_of_stepped(const std::string &name, int objects)
{
    const SceneFactory factory(benchmarks::spec_of_stepped_scene(name, objects, seed));
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    return hash_of(*benchmarks::make_stepped_scene(name, factory, space.get()), space.get());
}

/// Geoms by their numbers: the scene does not list them.
std::string hash_of_limit(const std::string &name, int objects)
{
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    const auto scene = benchmarks::make_limit_scene(name, objects, SpaceKind::simple, space.get());
    BitHash hash;
    add_geoms(hash, geoms_in(space.get()));
    for (int tick = 0; tick < ticks; ++tick)
    {
        PairList list;
        scene->advance();
        scene->collide(&list, &PairList::collect);
        add_pairs(hash, list.sorted());
        add_geoms(hash, geoms_in(space.get()));
    }
    return hash.text();
}

/// A box that falls on its edge and tumbles.
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
    dRandSetSeed(seed);
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

/// What motion depends on beside the worlds: the mathematical library, ODE, and the order in which a compiler evaluates operands.
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
    int objects;
    std::uint64_t seed;
    std::string hash;
};

std::ostream &operator<<(std::ostream &out, const Line &line)
{
    return out << line.name << ' ' << line.objects << ' ' << line.seed << ' ' << line.hash;
}

int objects_of(const std::string &name)
{
    const std::map<std::string, int> few = {{"ragdolls", 3},     {"chain", 1}, {"city", 5},   {"nested", 6},
                                            {"nested_empty", 8}, {"many", 17}, {"lidar", 40}, {"lidar_nested", 40},
                                            {"hills", 250},      {"reset", 12}};
    const auto found = few.find(name);
    return found == few.end() ? 60 : found->second;
}

std::vector<Line> lines()
{
    std::vector<Line> all;
    for (const std::string &name : scene_names())
        all.push_back({name, 100, seed, hash_of_factory(SceneFactory({name, 100, seed}))});
    all.push_back({"gas_of_which_a_tenth_moves", 100, seed, hash_of_factory(SceneFactory({"gas", 100, seed, 0.1}))});
    all.push_back({"mix_without_probe", 100, seed, hash_of_factory(SceneFactory({"mix", 100, seed, -1, false}))});
    for (const std::string &name : world_names())
        all.push_back({name, objects_of(name), seed, hash_of_factory(world_factory({name, objects_of(name), seed}))});
    for (const std::string &name : benchmarks::stepped_scene_names())
    {
        const bool is_one_of_scenes = name == "pile" || name == "stack";
        const bool is_new = name == "settling" || name == "dart" || name == "ask";
        if (!is_one_of_scenes)
            all.push_back({name + (is_new ? "" : "_stepped"), 100, seed, hash_of_stepped(name, 100)});
    }
    const std::map<std::string, std::string> renamed = {{"many", "gas"},
                                                        {"nested", "spaces_in_spaces"},
                                                        {"beside", "spaces_side_by_side"},
                                                        {"planes-all", "planes_all"},
                                                        {"planes-apart", "planes_apart"}};
    for (const std::string &name : benchmarks::limit_scene_names())
        all.push_back({renamed.count(name) != 0 ? renamed.at(name) : name, 50, 1, hash_of_limit(name, 50)});
    return all;
}

TEST(MotionHashes, AreThoseOfTheTable)
{
    const OdeSession ode;
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
    if (text != here)
        GTEST_SKIP() << "the table was written with another mathematical library, ODE or compiler: " << text << ", not "
                     << here;
    std::set<std::string> expected, found;
    while (std::getline(table, text))
        expected.insert(text);
    for (const Line &line : lines())
    {
        std::ostringstream one;
        one << line;
        found.insert(one.str());
    }
    EXPECT_EQ(found, expected);
}
} // namespace
} // namespace ode_predictive_space::scenes
