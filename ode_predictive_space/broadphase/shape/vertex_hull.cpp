#include "ode_predictive_space/broadphase/shape/vertex_hull.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include <Eigen/Geometry>

#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
namespace
{
Eigen::AlignedBox3d box_of(const Vector3 *begin, const Vector3 *end)
{
    Eigen::AlignedBox3d box;
    std::for_each(begin, end, [&box](const Vector3 &point) { box.extend(point); });
    return box;
}

void remove_equal(std::vector<Vector3> &points)
{
    std::sort(points.begin(), points.end(), [](const Vector3 &one, const Vector3 &other) {
        return std::tie(one[0], one[1], one[2]) < std::tie(other[0], other[1], other[2]);
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
}
} // namespace

VertexHull::VertexHull(std::vector<Vector3> points)
{
    remove_equal(points);
    const Eigen::AlignedBox3d box = box_of(points.data(), points.data() + points.size());
    centre_ = box.center();
    for (Vector3 &point : points)
        point -= centre_;
    half_sides_ = (box.max() - centre_).cwiseMax(centre_ - box.min());
    blocks_.resize((points.size() + block_size - 1) / block_size);
    bounds_.resize(2 * blocks_.size() - 1);
    build(points.data(), points.data() + points.size(), root());
}

void VertexHull::build(Vector3 *begin, Vector3 *end, const Range &range)
{
    const Eigen::AlignedBox3d box = box_of(begin, end);
    bounds_[range.node] = {box.center(), (box.max() - box.center()).cwiseMax(box.center() - box.min())};
    if (range.is_leaf())
    {
        for (Eigen::Index i = 0; i < block_size; ++i)
            blocks_[range.begin].row(i) = begin[std::min<std::ptrdiff_t>(i, end - begin - 1)].array();
        return;
    }
    Eigen::Index longest;
    box.sizes().maxCoeff(&longest);
    Vector3 *middle = begin + block_size * static_cast<std::ptrdiff_t>(range.middle() - range.begin);
    std::nth_element(begin, middle, end,
                     [longest](const Vector3 &one, const Vector3 &other) { return one[longest] < other[longest]; });
    build(begin, middle, range.left());
    build(middle, end, range.right());
}

Vector3 VertexHull::farthest(const Vector3 &direction) const
{
    const Block &block = blocks_[find(direction).block];
    Eigen::Index row;
    (block.matrix() * direction).maxCoeff(&row);
    return block.row(row);
}

VertexHull::Farthest VertexHull::find(const Vector3 &direction) const
{
    Farthest best{-std::numeric_limits<double>::infinity(), 0};
    search(root(), direction, direction.cwiseAbs(), best);
    return best;
}

void VertexHull::search(const Range &range, const Vector3 &direction, const Vector3 &absolute, Farthest &best) const
{
    if (range.is_leaf())
    {
        const Block &block = blocks_[range.begin];
        const double reach =
            (block.col(0) * direction[0] + block.col(1) * direction[1] + block.col(2) * direction[2]).maxCoeff();
        if (reach > best.reach)
            best = {reach, range.begin};
        return;
    }
    Range nearer = range.left(), farther = range.right();
    double less = bounds_[nearer.node].reach(direction, absolute),
           more = bounds_[farther.node].reach(direction, absolute);
    if (less > more)
    {
        std::swap(nearer, farther);
        std::swap(less, more);
    }
    if (more > best.reach)
        search(farther, direction, absolute, best);
    if (less > best.reach)
        search(nearer, direction, absolute, best);
}

std::size_t VertexHull::bytes() const
{
    return sizeof *this + bytes_of(blocks_) + bytes_of(bounds_) + (surface ? surface->bytes() : 0);
}
} // namespace ode_predictive_space
