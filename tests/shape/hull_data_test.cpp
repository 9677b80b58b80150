// Convexes and meshes are tested by the hull of their present data, however these are exchanged.

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <sys/mman.h>

#include <gtest/gtest.h>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
namespace
{
const Eigen::Vector3d same(1, 1, 1), here(0, 0, 0);

// An octahedron and a ball near its edge: the boxes overlap. Deviations are large, so that no object gets a new prediction.
class HullData : public OdeTest
{
protected:
    HullData()
    {
        dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
        for (int role : {dPredictiveRoleEnvironment, dPredictiveRoleInteractive})
            dPredictiveSpaceSetDeviation(space, role, 1, 0, 0);
        dPredictiveEncounter none;
        dPredictiveSpaceGetEncounters(space, ball, &none, 1);
        dPredictiveSpaceSetGeomRole(space, ball, dPredictiveRoleInteractive); // no gap test is saved
        dGeomSetPosition(ball, REAL(0.8), REAL(0.8), 0);
    }
    ~HullData() override { dSpaceDestroy(space); }

    dGeomID create_mesh(const MeshArrays &arrays)
    {
        return dCreateTriMesh(space, arrays.id(), nullptr, nullptr, nullptr);
    }

    // The ball moves, so that time passes.
    std::size_t pairs()
    {
        moves = -moves;
        dGeomSetPosition(ball, REAL(0.8) + moves, REAL(0.8), 0);
        const std::size_t count = collide(space).size();
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
        return count;
    }

    // A reported pair is tested again only after some ticks.
    std::size_t pairs_later()
    {
        for (int i = 0; i < 16; ++i)
            pairs();
        return pairs();
    }

    std::size_t pairs_at_rest()
    {
        for (int i = 0; i < 70; ++i)
            collide(space);
        const std::size_t count = collide(space).size();
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
        return count;
    }

    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const dGeomID ball = dCreateSphere(space, REAL(0.3));
    dReal moves = REAL(1e-6);

    const Polyhedron octahedron = Polyhedron::octahedron(), cube = Polyhedron::cube().changed(0.9 * same, here);
};

TEST_F(HullData, IsThatOfTheMeshDataThatWereSetAtRest)
{
    MeshArrays small(octahedron), large(cube);
    const dGeomID mesh = create_mesh(small);
    EXPECT_EQ(pairs_at_rest(), 0u);
    dGeomTriMeshSetData(mesh, large.id());
    EXPECT_EQ(collide(space).size(), 1u);
}

// ODE sends no notice.
TEST_F(HullData, IsThatOfMeshDataThatWereBuiltAnewAtRest)
{
    MeshArrays arrays(octahedron);
    create_mesh(arrays);
    EXPECT_EQ(pairs_at_rest(), 0u);
    arrays.rebuild(cube);
    EXPECT_EQ(collide(space).size(), 1u);
    EXPECT_EQ(pairs_at_rest(), 1u);
    arrays.rebuild(octahedron);
    EXPECT_EQ(pairs_at_rest(), 0u);
}

TEST_F(HullData, IsThatOfOtherMeshDataAtTheSamePlace)
{
    auto arrays = std::make_unique<MeshArrays>(octahedron);
    MeshArrays another(octahedron);
    const dGeomID mesh = create_mesh(*arrays);
    EXPECT_EQ(pairs(), 0u);
    dGeomTriMeshSetData(mesh, another.id());
    arrays->move_corners({0.4, 0.4, 0}); // like new data in the memory of the first
    dGeomTriMeshSetData(mesh, arrays->id());
    EXPECT_EQ(pairs(), 1u);
}

TEST_F(HullData, ChangedWhileNoGeomHasThemIsReadAnew)
{
    MeshArrays arrays(octahedron);
    const dGeomID first = create_mesh(arrays);
    EXPECT_EQ(pairs(), 0u);
    dGeomDestroy(first);
    arrays.move_corners({0.4, 0.4, 0});
    create_mesh(arrays);
    EXPECT_EQ(pairs(), 1u);
}

// The box test needs no call when data are changed.
TEST_F(HullData, ChangedDuringTheBoxTestIsReadAnew)
{
    MeshArrays arrays(octahedron);
    create_mesh(arrays);
    EXPECT_EQ(pairs(), 0u);
    dPredictiveSpaceSetProximity(space, dPredictiveProximityBox);
    arrays.move_corners({0.4, 0.4, 0});
    dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
    EXPECT_EQ(pairs(), 1u);
}

// The arrays stay the same.
TEST_F(HullData, IsThatOfTheTrianglesWithWhichTheDataWereBuiltLast)
{
    const double corners[][3] = {{1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {0.8, 0.8, -1}, {0.8, 0.8, 1}, {1, 1, 1}};
    const dTriIndex triangles[] = {0, 1, 2, 3, 4, 5, 0, 1, 2}; // the ball touches the second one
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    const auto build = [&](int count, int stride) {
        dGeomTriMeshDataBuildDouble(data, corners, sizeof corners[0], 6, triangles, 3 * count,
                                    stride * static_cast<int>(sizeof(dTriIndex)));
    };
    build(1, 3);
    const dGeomID mesh = dCreateTriMesh(space, data, nullptr, nullptr, nullptr);
    EXPECT_EQ(pairs_at_rest(), 0u);
    build(2, 3);
    EXPECT_EQ(pairs_at_rest(), 1u);
    build(2, 6);
    EXPECT_EQ(pairs_at_rest(), 0u);
    dGeomDestroy(mesh);
    dGeomTriMeshDataDestroy(data);
}

// A query needed the hull of the old data; their geom has got other data since.
TEST_F(HullData, ChangedWhileUnusedIsReadAgainAlsoAfterAQuestion)
{
    const Polyhedron small = octahedron.changed(0.7 * same, here); // the middle of the ball is beside its box
    MeshArrays arrays(small), others(small);
    const dGeomID first = create_mesh(arrays), probe = dCreateSphere(nullptr, REAL(0.3));
    dGeomSetPosition(probe, REAL(-0.8), REAL(-0.8), 0);
    EXPECT_EQ(collide2(probe, as_geom(space)).size(), 0u);
    dGeomDestroy(probe);
    dGeomTriMeshSetData(first, others.id());
    dGeomSetPosition(first, 50, 0, 0);
    EXPECT_EQ(pairs(), 0u);
    arrays.move_corners({0.4, 0.4, 0});
    create_mesh(arrays);
    EXPECT_EQ(pairs(), 1u);
}

// One call is enough for all geoms with these data.
TEST_F(HullData, ChangedInPlaceIsReadAnewForEveryGeomThatHasThem)
{
    MeshArrays arrays(octahedron);
    const dGeomID far = create_mesh(arrays);
    dGeomSetPosition(far, 50, 0, 0);
    create_mesh(arrays);
    dPredictiveSpacePrepare(space);
    EXPECT_EQ(pairs_at_rest(), 0u);
    arrays.move_corners({0.4, 0.4, 0});
    dPredictiveSpaceGeomChanged(space, far);
    EXPECT_EQ(collide(space).size(), 1u);
}

// ODE keeps the box that a mesh had when its data were built.
TEST_F(HullData, ChangedInPlaceIsNoticedInTheBoxesToo)
{
    dPredictiveSpaceSetProximity(space, dPredictiveProximityBox);
    ConvexArrays arrays(octahedron);
    const dGeomID convex = arrays.create(space);
    dGeomSetPosition(convex, 5, 0, 0);
    EXPECT_EQ(pairs_at_rest(), 0u);
    arrays.move_points({-5, 0, 0});
    dPredictiveSpaceGeomChanged(space, convex);
    EXPECT_EQ(collide(space).size(), 1u);
}

TEST_F(HullData, ChangedInPlaceIsNoticedByTheSpacesAround)
{
    const auto create = [](bool predictive, dSpaceID parent) {
        return predictive ? dPredictiveSpaceCreate(parent) : dSimpleSpaceCreate(parent);
    };
    for (const bool outer_predicts : {true, false})
        for (const bool middle_predicts : {true, false})
        {
            const dSpaceID outer = create(outer_predicts, nullptr), middle = create(middle_predicts, outer),
                           inner = dPredictiveSpaceCreate(middle);
            ConvexArrays arrays(octahedron);
            const dGeomID convex = arrays.create(inner);
            dGeomSetPosition(convex, 5, 0, 0);
            dCreateBox(outer, 1, 1, 1);
            for (int i = 0; i < 70; ++i)
                EXPECT_EQ(collide(outer).size(), 0u);
            arrays.move_points({-5, 0, 0});
            dPredictiveSpaceGeomChanged(inner, convex);
            EXPECT_EQ(collide(outer).size(), 1u) << outer_predicts << middle_predicts;
            EXPECT_TRUE(!outer_predicts || dPredictiveSpaceValidate(outer) == 1);
            dSpaceDestroy(outer);
        }
}

// The sheet is not flat in its own axes, either.
TEST_F(HullData, OfVeryManyPointsIsTheBoxOfItsOwnAxes)
{
    MeshArrays arrays(Polyhedron::sheet(149, 149, [](double u, double v) {
        const double x = 2 * v - 1, y = 1 - 2 * u;
        return Eigen::Vector3d(x, y, 0.1 * x * y);
    }));
    const dGeomID mesh = create_mesh(arrays);
    dPredictiveSpacePrepare(space);
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, 0, 1, 0, REAL(0.785398));
    dGeomSetRotation(mesh, turned);
    dGeomSetPosition(ball, REAL(0.5), 0, REAL(0.5));
    EXPECT_EQ(collide(space).size(), 0u);
    dGeomSetPosition(ball, REAL(0.3), 0, REAL(-0.3));
    EXPECT_EQ(collide(space).size(), 1u);
}

TEST_F(HullData, OfMeshesThatAreGoneTakeNoMemory)
{
    const auto bytes = [this] {
        dPredictiveSpaceStats stats;
        dPredictiveSpaceGetStats(space, &stats);
        return stats.bytes;
    };
    std::vector<std::unique_ptr<MeshArrays>> all; // none has the place of another
    const auto come_and_go = [&] {
        for (int i = 0; i < 50; ++i)
        {
            all.push_back(std::make_unique<MeshArrays>(octahedron));
            const dGeomID mesh = create_mesh(*all.back());
            EXPECT_EQ(collide(space).size(), 0u);
            dGeomDestroy(mesh);
        }
        return bytes();
    };
    const unsigned long first = come_and_go();
    EXPECT_LE(come_and_go(), first);
}

TEST_F(HullData, OfAMeshThatIsNotFiniteIsNone)
{
    Polyhedron wrong = octahedron;
    wrong.corners[4][2] = std::numeric_limits<double>::infinity();
    MeshArrays arrays(octahedron);
    const dGeomID mesh = create_mesh(arrays);
    EXPECT_EQ(pairs(), 0u);
    MeshArrays infinite(wrong);
    dGeomTriMeshSetData(mesh, infinite.id());
    EXPECT_EQ(pairs(), 1u) << "judged by its box";
}

TEST_F(HullData, OfARoomLeavesOutWhatIsInsideAndApartFromItsWalls)
{
    MeshArrays arrays(Polyhedron::cube().changed(3 * same, here));
    const dGeomID mesh = create_mesh(arrays);
    EXPECT_EQ(pairs(), 0u);
    dGeomSetPosition(mesh, 0, 0, REAL(2.8));
    EXPECT_EQ(pairs(), 1u) << "on the floor";
    dGeomSetPosition(mesh, 0, 0, 0);
    EXPECT_EQ(pairs_later(), 0u);
    arrays.move_corners({0, 0, 2.8});
    dPredictiveSpaceGeomChanged(space, mesh);
    EXPECT_EQ(pairs(), 1u) << "on the floor of changed data";
}

// Small cubes in two layers, above and below the ball: within the hull, triangles decide. Their tree takes several ticks.
Polyhedron layers_of_cubes()
{
    Polyhedron many;
    for (unsigned i = 0; i < 3000; ++i)
        many.add(Polyhedron::cube().changed(0.01 * same, {0.02 * (i % 100), 0.1 * (i / 100), i % 2 ? 1.0 : -1.0}));
    return many;
}

TEST_F(HullData, OfALargeMeshIsNotReadAfterItWasDestroyed)
{
    auto arrays = std::make_unique<MeshArrays>(layers_of_cubes());
    const dGeomID mesh = create_mesh(*arrays);
    EXPECT_EQ(pairs(), 1u) << "the tree is not ready";
    dGeomDestroy(mesh);
    arrays.reset();
    EXPECT_EQ(pairs(), 0u);
}

// Numbers whose memory is unmapped at the end, so that a later read ends the program.
class MappedNumbers
{
public:
    explicit MappedNumbers(const std::vector<Eigen::Vector3d> &vectors)
        : bytes_(vectors.size() * sizeof vectors[0]),
          place_(mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))
    {
        if (place_ == MAP_FAILED)
            throw std::bad_alloc();
        std::memcpy(place_, vectors.data(), bytes_);
    }
    ~MappedNumbers() { munmap(place_, bytes_); }
    MappedNumbers(const MappedNumbers &) = delete;
    MappedNumbers &operator=(const MappedNumbers &) = delete;

    const double *data() const { return static_cast<const double *>(place_); }

private:
    std::size_t bytes_;
    void *place_;
};

// The program frees the first vertices as soon as the mesh data have others.
TEST_F(HullData, OfALargeMeshIsNotReadAfterItsDataWereBuiltFromOthers)
{
    const Polyhedron large = layers_of_cubes();
    std::vector<dTriIndex> triangles;
    for (const std::vector<unsigned> &face : large.faces)
        for (std::size_t i = 2; i < face.size(); ++i)
            triangles.insert(triangles.end(), {face[0], face[i - 1], face[i]});
    MeshArrays arrays(octahedron);
    auto vertices = std::make_unique<MappedNumbers>(large.corners);
    dGeomTriMeshDataBuildDouble(arrays.id(), vertices->data(), 3 * sizeof(double),
                                static_cast<int>(large.corners.size()), triangles.data(),
                                static_cast<int>(triangles.size()), 3 * sizeof(dTriIndex));
    create_mesh(arrays);
    EXPECT_EQ(pairs(), 1u) << "the tree is not ready";
    arrays.rebuild(octahedron);
    vertices.reset();
    EXPECT_EQ(pairs_later(), 0u);
    arrays.rebuild(cube);
    EXPECT_EQ(pairs(), 1u);
}

// Flat ground with a peak at one corner, which makes the box of the field high. The ball is inside this box.
class HullOfHeights : public HullData
{
protected:
    HullOfHeights()
    {
        dGeomSetPosition(ball, 0, REAL(0.9), 0);
        build(low, 0);
        build(high, REAL(0.8));
    }
    ~HullOfHeights() override
    {
        for (const dHeightfieldDataID data : {low, high})
            dGeomHeightfieldDataDestroy(data);
    }

    void build(dHeightfieldDataID data, dReal offset, dReal scale = 1, dReal depth = 8) const
    {
        dGeomHeightfieldDataBuildDouble(data, samples.data(), 0, 8, depth, 5, 5, scale, offset, 1, 0);
    }

    dGeomID create_field(dHeightfieldDataID data)
    {
        const dGeomID field = dCreateHeightfield(space, data, 1);
        dGeomSetPosition(field, 0, 0, 0);
        return field;
    }

    bool has_contact(dGeomID field) const
    {
        dContactGeom contact;
        return dCollide(field, ball, 1, &contact, sizeof contact) > 0;
    }

    const dHeightfieldDataID low = dGeomHeightfieldDataCreate(), high = dGeomHeightfieldDataCreate();
    std::array<double, 25> samples = {3};
};

TEST_F(HullOfHeights, IsThatOfEachOffsetWhereFieldsHaveTheirSamplesInCommon)
{
    const dGeomID below = create_field(low);
    EXPECT_EQ(collide(space).size(), 0u);
    EXPECT_FALSE(has_contact(below));
    const dGeomID above = create_field(high);
    EXPECT_TRUE(has_contact(above));
    EXPECT_EQ(collide(space).size(), 2u) << "the ball on the higher field, and the fields";
    dGeomDestroy(below);
    EXPECT_EQ(collide(space).size(), 1u);
}

TEST_F(HullOfHeights, IsThatOfTheOffsetWithWhichTheDataWereBuiltLast)
{
    const dGeomID field = create_field(low);
    EXPECT_EQ(collide(space).size(), 0u);
    build(low, REAL(0.8));
    EXPECT_TRUE(has_contact(field));
    EXPECT_EQ(collide(space).size(), 1u);
}

TEST_F(HullOfHeights, IsThatOfTheScaleAndTheDepthWithWhichTheDataWereBuiltLast)
{
    for (const bool steeper : {true, false})
    {
        dGeomSetPosition(ball, REAL(-3.3), steeper ? REAL(3.2) : REAL(1.2), REAL(-3.3)); // beside the peak
        build(low, 0, 1, steeper ? 8 : 16);
        const dGeomID field = create_field(low);
        EXPECT_EQ(collide(space).size(), 0u) << steeper;
        build(low, 0, steeper ? 3 : 1, 8);
        EXPECT_EQ(collide(space).size(), 1u) << steeper;
        dGeomDestroy(field);
    }
}

TEST_F(HullOfHeights, ChangedInPlaceIsReadAnewForOtherDataWithTheSameSamples)
{
    build(high, REAL(0.1));
    create_field(high);
    const dGeomID far = create_field(low);
    dGeomSetPosition(far, 50, 0, 0);
    EXPECT_EQ(collide(space).size(), 0u);
    samples.fill(0.6);
    dPredictiveSpaceGeomChanged(space, far);
    EXPECT_EQ(collide(space).size(), 1u);
}

// For a heightfield ODE uses the box that its data were built with; other data with the same arrays may have another box.
TEST_F(HullData, HasTheOldBoxOfItsOwnDataWhereOthersHaveTheSameArrays)
{
    std::mt19937 random(3);
    const auto place = [&random] { return std::uniform_real_distribution<float>(-1, 1)(random); };
    std::array<float, 36> vertices{}, heights{};
    std::array<dTriIndex, 12> triangles{};
    std::iota(triangles.begin(), triangles.end(), 0);
    const auto build = [&] {
        const dTriMeshDataID data = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(data, vertices.data(), 3 * sizeof(float), 12, triangles.data(), 12,
                                    3 * sizeof(dTriIndex));
        return data;
    };
    int contacts = 0;
    for (int world = 0; world < 30; ++world)
    {
        std::generate(vertices.begin(), vertices.end(), [&] { return 3 * place(); });
        std::generate(heights.begin(), heights.end(), place);
        const dHeightfieldDataID ground = dGeomHeightfieldDataCreate();
        dGeomHeightfieldDataBuildSingle(ground, heights.data(), 0, 5, 5, 6, 6, 1, 0, 1, 0);
        const dTriMeshDataID built_before = build();
        const dGeomID field = dCreateHeightfield(space, ground, 1),
                      mesh = dCreateTriMesh(space, built_before, nullptr, nullptr, nullptr);
        number_geom(field, 1000);
        number_geom(mesh, 1001);
        collide(space);
        std::transform(vertices.begin(), vertices.end(), vertices.begin(), [](float x) { return x / 5; });
        dPredictiveSpaceGeomChanged(space, mesh);
        const dTriMeshDataID built_after = build();
        const dGeomID other = dCreateTriMesh(space, built_after, nullptr, nullptr, nullptr);
        number_geom(other, 1002);
        dGeomSetPosition(mesh, 0, world % 2 ? 100 : 0, 0); // the hull of either is made first
        collide(space);
        for (int tick = 0; tick < 40; ++tick)
        {
            dGeomSetPosition(other, place(), place(), place());
            dGeomSetPosition(mesh, place(), 3 * place() + 1, place());
            const Pairs reported = unordered(collide(space));
            dContactGeom contact;
            const bool touches = dCollide(field, mesh, 1, &contact, sizeof contact) > 0;
            contacts += touches;
            EXPECT_TRUE(!touches || std::count(reported.begin(), reported.end(), Pair(1000, 1001)))
                << world << " " << tick;
        }
        for (const dGeomID geom : {other, mesh, field})
            dGeomDestroy(geom);
        dGeomTriMeshDataDestroy(built_before);
        dGeomTriMeshDataDestroy(built_after);
        dGeomHeightfieldDataDestroy(ground);
    }
    EXPECT_GT(contacts, 100);
}
} // namespace
} // namespace ode_predictive_space
