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

TEST_F(TriangleTrees, HaveChildrenBehindTheirParentsAndInTheirBoxes)
{
    const Mesh mesh = soup(1000, 0.1);
    TriangleTree tree(mesh.arrays());
    tree.build(all_at_once);
    std::vector<int> parents(tree.nodes().size()), leaves(tree.count());
    const auto holds = [](const TriangleTree::Node &node, const Vector3 &low, const Vector3 &high) {
        return (node.low.cast<double>().array() <= low.array()).all() &&
               (node.high.cast<double>().array() >= high.array()).all();
    };
    for (std::size_t index = 0; index < tree.nodes().size(); ++index)
    {
        const TriangleTree::Node &node = tree.nodes()[index];
        for (std::uint32_t i = node.first; i < node.end; ++i)
        {
            const std::uint32_t triangle = tree.order()[i];
            for (const Vector3 &corner : tree.corners(triangle))
                EXPECT_TRUE(holds(node, corner, corner));
            ++leaves[triangle];
        }
        for (std::uint32_t i = node.first; !node.is_leaf() && i < node.first + 2; ++i)
        {
            ASSERT_GT(i, index);
            const TriangleTree::Node &child = tree.nodes().at(i);
            EXPECT_TRUE(holds(node, child.low.cast<double>(), child.high.cast<double>()));
            ++parents[i];
        }
    }
    EXPECT_EQ(leaves, std::vector<int>(tree.count(), 1));
    EXPECT_EQ(parents[0], 0);
    EXPECT_EQ(std::count(parents.begin(), parents.end(), 1), std::ptrdiff_t(parents.size()) - 1);
}

// All nodes above an entered node are entered, too.
TEST_F(TriangleTrees, VisitTheTrianglesOfEnteredNodesInOneOrder)
{
    const Mesh mesh = soup(1000, 0.1);
    TriangleTree tree(mesh.arrays());
    tree.build(all_at_once);
    std::vector<std::uint32_t> all;
    tree.descend([](std::uint32_t) { return true; }, [&](std::uint32_t triangle) { all.push_back(triangle); });
    EXPECT_EQ(std::set<std::uint32_t>(all.begin(), all.end()).size(), tree.count());
    for (int i = 0; i < 20; ++i)
    {
        const Vector3 point = vector();
        const double square = between(0, 0.1);
        const auto is_near = [&](std::uint32_t node) { return tree.nodes()[node].squared_distance(point) <= square; };
        std::set<std::uint32_t> near;
        for (std::uint32_t index = 0; index < tree.nodes().size(); ++index)
        {
            const TriangleTree::Node &node = tree.nodes()[index];
            if (node.is_leaf() && is_near(index))
                near.insert(tree.order().begin() + node.first, tree.order().begin() + node.end);
        }
        std::vector<std::uint32_t> expected, found;
        std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
                     [&](std::uint32_t triangle) { return near.count(triangle) == 1; });
        tree.descend(is_near, [&](std::uint32_t triangle) { found.push_back(triangle); });
        EXPECT_EQ(found, expected);
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
    const Mesh mesh = soup(1000, 0.1);
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
