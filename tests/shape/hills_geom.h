// Heightfields of random hills, from every source of samples that ODE has.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SHAPE_HILLS_GEOM_H
#define ODE_PREDICTIVE_SPACE_TESTS_SHAPE_HILLS_GEOM_H

#include <random>
#include <vector>

#include <Eigen/Core>
#include <ode/ode.h>

namespace ode_predictive_space
{
/// The data of a heightfield; they must outlive the geom. Some repeat without end, some have flat parts, some are upside down.
class Hills
{
public:
    /// @param width approximate width and depth of all cells together.
    /// @param height approximate difference of the highest and the lowest sample.
    Hills(std::mt19937_64 &random, double width, double height, bool may_repeat = true);
    ~Hills();
    Hills(const Hills &) = delete;
    Hills &operator=(const Hills &) = delete;

    dHeightfieldDataID id() const { return id_; }
    /// A place near the ground, or slightly beyond its edge, in the frame of the geom.
    Eigen::Vector3d place(std::mt19937_64 &random) const;
    Eigen::Vector3d sides() const { return {width_, 0, depth_}; }
    Eigen::Vector3d cell() const { return {width_ / (columns_ - 1), 0, depth_ / (rows_ - 1)}; }
    double height(int column, int row) const;
    double highest() const;
    /// The lowest sample of the cells below or above a box, or of the whole if the field repeats.
    double lowest_beside(const Eigen::Vector3d &centre, const Eigen::Vector3d &half) const;
    int columns() const { return columns_; }
    int rows() const { return rows_; }

    /// Puts other samples into the same memory. ODE keeps the old bounds.
    void change_in_place(std::mt19937_64 &random);
    /// Puts other samples into other memory, from another source, under the same id.
    void rebuild(std::mt19937_64 &random);

private:
    static dReal callback(void *hills, int column, int row);
    int lowest_sample() const;
    void fill(std::mt19937_64 &random);
    void build(std::mt19937_64 &random);

    dHeightfieldDataID id_ = dGeomHeightfieldDataCreate();
    double width_, depth_, height_;
    bool repeats_;
    int columns_, rows_;
    int source_ = 0;
    dReal scale_ = 1, offset_ = 0;
    std::vector<unsigned char> bytes_;
    std::vector<short> shorts_;
    std::vector<float> floats_;
    std::vector<double> doubles_;
    std::vector<dReal> computed_; // values of the callback
};
} // namespace ode_predictive_space

#endif
