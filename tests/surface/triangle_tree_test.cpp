// Trees of random triangles: every triangle that is near a point is found, also if triangles coincide.

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "ode_predictive_space/surface/triangle_tree.h"

namespace ode_predictive_space
{
namespace
{
class Mesh
{
public:
    void add(const TriangleCorners &corners)
    {
        for (const Vector3 &corner : corners)
        {
            triangles_.push_back(static_cast<std::uint32_t>(vertices_.size() / 3));
            for (Eigen::Index i = 0; i < 3; ++i)
                vertices_.push_back(corner[i]);
        }
    }

    void add_without_vertices() { triangles_.insert(triangles_.end(), 3, std::numeric_limits<std::uint32_t>::max()); }

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

    // @param next makes a triangle, given the number of those before it.
    void expect_all_near_found(int triangles, const std::function<TriangleCorners(int)> &next)
    {
        Mesh mesh;
        for (int i = 0; i < triangles; ++i)
            mesh.add(next(i));
        TriangleTree tree(mesh.arrays());
        std::set<std::uint32_t> all;
        for (std::uint32_t triangle = 0; triangle < tree.count(); ++triangle)
            all.insert(triangle);
        expect_near_found(tree, all);
    }

    // @param held numbers of the triangles in the tree.
    void expect_near_found(TriangleTree &tree, const std::set<std::uint32_t> &held)
    {
        tree.build(all_at_once);
        ASSERT_TRUE(tree.is_ready());
        for (int i = 0; i < 100; ++i)
        {
            const Vector3 point = 1.5 * vector();
            const double most = between(0, 0.5);
            const std::vector<std::uint32_t> found = visited(tree, point, most);
            const std::set<std::uint32_t> different(found.begin(), found.end());
            ASSERT_EQ(different.size(), found.size()) << "none is visited twice";
            ASSERT_TRUE(std::includes(held.begin(), held.end(), different.begin(), different.end()));
            for (const std::uint32_t triangle : held)
                ASSERT_TRUE(different.count(triangle) == 1 || distance(point, tree.corners(triangle)) > most);
        }
    }

    Mesh soup(int triangles, double size)
    {
        Mesh mesh;
        for (int i = 0; i < triangles; ++i)
        {
            const Vector3 place = vector();
            mesh.add({place, place + size * vector(), place + size * vector()});
        }
        return mesh;
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

// No plane divides coinciding triangles.
TEST_F(TriangleTrees, FindAllThatAreNearWhereTrianglesCoincide)
{
    const TriangleCorners same = {vector(), vector(), vector()};
    expect_all_near_found(1000, [&](int) { return same; });
}

// The middle of the extent leaves nearly all triangles on one side.
TEST_F(TriangleTrees, FindAllThatAreNearWhereTrianglesCrowd)
{
    expect_all_near_found(1000, [this](int i) -> TriangleCorners {
        const double place = std::pow(0.9, i);
        return {place * vector(), place * vector(), place * vector()};
    });
}

// At each middle, hardly more than a sixteenth of the triangles goes to one side. A walk has room for a depth of 95.
TEST_F(TriangleTrees, AreNotTooDeepForAWalkWhereTrianglesCrowd)
{
    Mesh mesh;
    double x = 1;
    for (int left = 10000; left > 0; x *= 0.45)
        for (int i = left / 16; i >= 0; --i, --left)
            mesh.add({Vector3(x, 0, 0), Vector3(x, x / 2, 0), Vector3(x, 0, x / 2)});
    TriangleTree tree(mesh.arrays());
    tree.build(all_at_once);
    ASSERT_TRUE(tree.is_ready());
    std::vector<int> depths(tree.nodes().size());
    for (std::size_t i = 0; i < depths.size(); ++i)
        if (const TriangleTree::Node &node = tree.nodes()[i]; !node.is_leaf())
            depths[node.first] = depths[node.first + 1] = depths[i] + 1;
    EXPECT_LT(*std::max_element(depths.begin(), depths.end()), 95);
}

// Triangles that are left out are not even read.
TEST_F(TriangleTrees, FindAllThatAreNearAmongThoseThatTheyHold)
{
    Mesh mesh;
    std::set<std::uint32_t> held;
    for (std::uint32_t i = 0; i < 1000; ++i)
    {
        const Vector3 place = vector();
        if (i % 3 == 0)
        {
            mesh.add_without_vertices();
            continue;
        }
        mesh.add({place, place + 0.2 * vector(), place + 0.2 * vector()});
        if (i % 3 == 1)
            held.insert(i);
    }
    TriangleTree tree(mesh.arrays(), {held.begin(), held.end()});
    EXPECT_EQ(tree.count(), 1000u);
    expect_near_found(tree, held);
}

TEST_F(TriangleTrees, OfNoTrianglesVisitNone)
{
    const Mesh mesh = soup(1, 1);
    TriangleTree tree(mesh.arrays(), {}), empty(Mesh().arrays());
    for (TriangleTree *of_none : {&tree, &empty})
    {
        of_none->build(all_at_once);
        EXPECT_TRUE(of_none->is_ready());
        ASSERT_EQ(of_none->nodes().size(), 1u);
        EXPECT_TRUE(of_none->nodes()[0].is_leaf());
        EXPECT_TRUE(visited(*of_none, vector(), std::numeric_limits<double>::infinity()).empty());
        int visits = 0;
        of_none->descend([](std::uint32_t) { return true; }, [&](std::uint32_t) { ++visits; });
        EXPECT_EQ(visits, 0);
    }
}

TEST_F(TriangleTrees, NearerBoxesComeFirst)
{
    const Mesh mesh = soup(10000, 0.01);
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
} // namespace
} // namespace ode_predictive_space
