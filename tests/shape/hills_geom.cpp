#include "tests/shape/hills_geom.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ode_predictive_space
{
namespace
{
constexpr int sources = 5, bytes = 1;
constexpr double samples_up = 200; // from the lowest to the highest sample

double between(std::mt19937_64 &random, double low, double high)
{
    return std::uniform_real_distribution<double>(low, high)(random);
}
} // namespace

Hills::Hills(std::mt19937_64 &random, double width, double height, bool may_repeat)
    : width_(width), depth_(width * between(random, 0.5, 2)), height_(height),
      repeats_(may_repeat && random() % 4 == 0), columns_(2 + static_cast<int>(random() % 12)),
      rows_(2 + static_cast<int>(random() % 12))
{
    rebuild(random);
}

Hills::~Hills()
{
    dGeomHeightfieldDataDestroy(id_);
}

dReal Hills::callback(void *hills, int column, int row)
{
    const Hills &self = *static_cast<const Hills *>(hills);
    return self.computed_[static_cast<std::size_t>(column + row * self.columns_)];
}

// All sources but bytes have samples below 0.
int Hills::lowest_sample() const
{
    return source_ == bytes ? 0 : -100;
}

void Hills::fill(std::mt19937_64 &random)
{
    const bool is_flat = random() % 8 == 0, has_flat_parts = random() % 2 == 0;
    for (std::size_t i = 0; i < bytes_.size(); ++i)
    {
        const bool is_low = is_flat || (has_flat_parts && random() % 2 == 0);
        const int sample = lowest_sample() + static_cast<int>(is_low ? 0 : between(random, 0, samples_up));
        bytes_[i] = static_cast<unsigned char>(sample);
        shorts_[i] = static_cast<short>(sample);
        floats_[i] = static_cast<float>(sample);
        doubles_[i] = computed_[i] = sample;
    }
}

void Hills::rebuild(std::mt19937_64 &random)
{
    const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    bytes_.resize(count);
    shorts_.resize(count);
    floats_.resize(count);
    doubles_.resize(count);
    computed_.resize(count);
    source_ = static_cast<int>(random() % sources);
    scale_ = static_cast<dReal>(height_ / samples_up * (random() % 4 == 0 ? -1 : 1));
    offset_ = static_cast<dReal>(random() % 2 == 0 ? 0 : height_ * between(random, -1, 1));
    fill(random);
    build(random);
}

void Hills::change_in_place(std::mt19937_64 &random)
{
    fill(random);
}

void Hills::build(std::mt19937_64 &random)
{
    const auto width = static_cast<dReal>(width_), depth = static_cast<dReal>(depth_),
               thickness = static_cast<dReal>(height_ * between(random, 0, 1));
    const double highest_sample = lowest_sample() + samples_up;
    switch (source_)
    {
    case 0:
        dGeomHeightfieldDataBuildCallback(id_, this, &callback, width, depth, columns_, rows_, scale_, offset_,
                                          thickness, repeats_);
        dGeomHeightfieldDataSetBounds(id_, static_cast<dReal>(scale_ < 0 ? highest_sample : lowest_sample()),
                                      static_cast<dReal>(scale_ < 0 ? lowest_sample() : highest_sample));
        break;
    case bytes:
        dGeomHeightfieldDataBuildByte(id_, bytes_.data(), 0, width, depth, columns_, rows_, scale_, offset_, thickness,
                                      repeats_);
        break;
    case 2:
        dGeomHeightfieldDataBuildShort(id_, shorts_.data(), 0, width, depth, columns_, rows_, scale_, offset_,
                                       thickness, repeats_);
        break;
    case 3:
        dGeomHeightfieldDataBuildSingle(id_, floats_.data(), 0, width, depth, columns_, rows_, scale_, offset_,
                                        thickness, repeats_);
        break;
    default:
        dGeomHeightfieldDataBuildDouble(id_, doubles_.data(), 0, width, depth, columns_, rows_, scale_, offset_,
                                        thickness, repeats_);
    }
}

double Hills::height(int column, int row) const
{
    return computed_[static_cast<std::size_t>(column + row * columns_)] * scale_ + offset_;
}

double Hills::highest() const
{
    const auto [low, high] = std::minmax_element(computed_.begin(), computed_.end());
    return std::max(*low * scale_, *high * scale_) + offset_;
}

double Hills::lowest_beside(const Eigen::Vector3d &centre, const Eigen::Vector3d &half) const
{
    const auto first = [&](Eigen::Index axis, double side, int samples) {
        const double begin = (centre[axis] - half[axis] + 0.5 * side) / side * (samples - 1);
        return repeats_ ? 0 : static_cast<int>(std::clamp<double>(std::floor(begin), 0, samples - 2));
    };
    const auto last = [&](Eigen::Index axis, double side, int samples) {
        const double end = (centre[axis] + half[axis] + 0.5 * side) / side * (samples - 1);
        return repeats_ ? samples - 1 : static_cast<int>(std::clamp<double>(std::ceil(end), 1, samples - 1));
    };
    double lowest = highest();
    for (int row = first(2, depth_, rows_); row <= last(2, depth_, rows_); ++row)
        for (int column = first(0, width_, columns_); column <= last(0, width_, columns_); ++column)
            lowest = std::min(lowest, height(column, row));
    return lowest;
}

Eigen::Vector3d Hills::place(std::mt19937_64 &random) const
{
    const int column = static_cast<int>(random() % static_cast<unsigned>(columns_)),
              row = static_cast<int>(random() % static_cast<unsigned>(rows_));
    const double x = (column + between(random, -0.6, 0.6)) / (columns_ - 1),
                 z = (row + between(random, -0.6, 0.6)) / (rows_ - 1);
    return {width_ * (x - 0.5), height(column, row), depth_ * (z - 0.5)};
}
} // namespace ode_predictive_space
