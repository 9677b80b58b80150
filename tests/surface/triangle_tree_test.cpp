// Trees of triangles of meshes at random: every triangle that is near a point is found, also where triangles coincide.

#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "ode_predictive_space/surface/triangle_tree.h"

namespace ode_predictive_space
{
namespace
{
// The arrays of a program.
class Mesh
{
public:
    void add(const TriangleCorners &corners)
    {
        for (const Vector3 &corner : corners)
            for (Eigen::Index i = 0; i < 3; ++i)
                vertices_.push_back(corner[i]);
        for (int i = 0; i < 3; ++i)
            triangles_.push_back(static_cast<std::uint32_t>(triangles_.size()));
    }

    TriangleArrays arrays() const
    {
        return {vertices_.data(),
                3 * sizeof(double),
                static_cast<unsigned>(vertices_.size() / 3),
                triangles_.data(),
                static_cast<unsigned>(triangles_.size() / 3),
                3 * sizeof(std::uint32_t),
                false};
    }

private:
    std::vector<double> vertices_;
    std::vector<std::uint32_t> triangles_;
};

class TriangleTrees : public testing::Test
{
protected:
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    Vector3 vector() { return Vector3(between(-1, 1), between(-1, 1), between(-1, 1)); }

    static constexpr std::size_t all_at_once = 1000000;

    static double distance(const Vector3 &point, const TriangleCorners &corners)
    {
        return std::sqrt(nearest_on_triangle(point, corners).squared_distance);
    }

    static std::vector<std::uint32_t> visited(const TriangleTree &tree, const Vector3 &point, double distance)
    {
        std::vector<std::uint32_t> found;
        tree.walk(point, distance, [&](std::uint32_t triangle) {
            found.push_back(triangle);
            return true;
        });
        return found;
    }

    // @param next makes a triangle, given how many there are.
    void expect_all_near_found(int triangles, const std::function<TriangleCorners(int)> &next)
    {
        Mesh mesh;
        for (int i = 0; i < triangles; ++i)
            mesh.add(next(i));
        TriangleTree tree(mesh.arrays());
        tree.build(all_at_once);
        ASSERT_TRUE(tree.is_ready());
        for (int i = 0; i < 100; ++i)
        {
            const Vector3 point = 1.5 * vector();
            const double most = between(0, 0.5);
            const std::vector<std::uint32_t> found = visited(tree, point, most);
            const std::set<std::uint32_t> different(found.begin(), found.end());
            ASSERT_EQ(different.size(), found.size()) << "none is visited twice";
            for (std::uint32_t triangle = 0; triangle < tree.count(); ++triangle)
                ASSERT_TRUE(different.count(triangle) == 1 || distance(point, tree.corners(triangle)) > most);
        }
    }

    std::mt19937_64 random_{1};
};

TEST_F(TriangleTrees, FindAllThatAreNearInASoup)
{
    for (int triangles : {1, 2, 4, 5, 100, 3000})
        expect_all_near_found(triangles, [this](int) -> TriangleCorners {
            const Vector3 place = vector();
            return {place, place + 0.2 * vector(), place + 0.2 * vector()};
        });
}

// No plane divides these.
TEST_F(TriangleTrees, FindAllThatAreNearWhereTrianglesCoincide)
{
    const TriangleCorners same = {vector(), vector(), vector()};
    expect_all_near_found(1000, [&](int) { return same; });
}

// The middle of the extent leaves nearly all on one side.
TEST_F(TriangleTrees, FindAllThatAreNearWhereTrianglesCrowd)
{
    expect_all_near_found(1000, [this](int i) -> TriangleCorners {
        const double place = std::pow(0.9, i);
        return {place * vector(), place * vector(), place * vector()};
    });
}

TEST_F(TriangleTrees, NearerBoxesComeFirst)
{
    Mesh mesh;
    for (int i = 0; i < 10000; ++i)
    {
        const Vector3 place = vector();
        mesh.add({place, place + 0.01 * vector(), place + 0.01 * vector()});
    }
    TriangleTree tree(mesh.arrays());
    tree.build(all_at_once);
    double most = 10;
    int visits = 0;
    const Vector3 point = 0.5 * vector();
    tree.walk(point, most, [&](std::uint32_t triangle) {
        most = std::min(most, distance(point, tree.corners(triangle)));
        ++visits;
        return true;
    });
    EXPECT_LT(visits, 100);
    for (std::uint32_t triangle = 0; triangle < tree.count(); ++triangle)
        EXPECT_GE(distance(point, tree.corners(triangle)), most);
}

TEST_F(TriangleTrees, EndAWalkWhenTheVisitorSaysSo)
{
    Mesh mesh;
    for (int i = 0; i < 100; ++i)
        mesh.add({vector(), vector(), vector()});
    TriangleTree tree(mesh.arrays());
    tree.build(all_at_once);
    int visits = 0;
    tree.walk(Vector3::Zero(), 10, [&](std::uint32_t) { return ++visits < 7; });
    EXPECT_EQ(visits, 7);
}

TEST_F(TriangleTrees, AreTheSameInSlicesOfAnySize)
{
    Mesh mesh;
    for (int i = 0; i < 1000; ++i)
    {
        const Vector3 place = vector();
        mesh.add({place, place + 0.1 * vector(), place + 0.1 * vector()});
    }
    TriangleTree whole(mesh.arrays()), sliced(mesh.arrays());
    const std::size_t steps = all_at_once - whole.build(all_at_once);
    std::size_t slices = 0;
    for (; !sliced.is_ready(); ++slices)
        EXPECT_TRUE(sliced.build(17) == 0 || sliced.is_ready());
    EXPECT_EQ(slices, (steps + 16) / 17);
    for (int i = 0; i < 20; ++i)
    {
        const Vector3 point = vector();
        EXPECT_EQ(visited(sliced, point, 0.3), visited(whole, point, 0.3));
    }
}

TEST_F(TriangleTrees, NeedFewBytesForEachTriangle)
{
    constexpr int side = 200;
    Mesh mesh;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
        {
            const Vector3 corner(x, y, 0);
            mesh.add({corner, corner + Vector3::UnitX(), corner + Vector3::UnitY()});
            mesh.add({corner + Vector3(1, 1, 0), corner + Vector3::UnitY(), corner + Vector3::UnitX()});
        }
    TriangleTree tree(mesh.arrays());
    tree.build(100 * all_at_once);
    EXPECT_LE(tree.bytes(), 48u * tree.count());
}
} // namespace
} // namespace ode_predictive_space
