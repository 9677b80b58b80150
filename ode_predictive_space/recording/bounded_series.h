#ifndef ODE_PREDICTIVE_SPACE_RECORDING_BOUNDED_SERIES_H
#define ODE_PREDICTIVE_SPACE_RECORDING_BOUNDED_SERIES_H

#include <cstddef>
#include <cstdint>

namespace ode_predictive_space::recording
{
/// A series of any length in bounded memory, as mean and largest of equally many successive values in each column. When all
/// columns are full, neighbours are merged. Plain data; all zeros: empty.
class BoundedSeries
{
public:
    static constexpr std::size_t most_columns = 400; ///< even

    void add(double value);

    /// 0 … most_columns, whatever the memory holds.
    std::size_t columns() const;

    std::uint64_t values_per_column() const { return std::uint64_t{1} << (doublings_ & 63); }

    double mean(std::size_t column) const;
    double largest(std::size_t column) const { return columns_[column].largest; }

private:
    struct Column
    {
        float sum;
        float largest;
    };

    void merge_neighbours();

    std::uint64_t values_;
    std::uint64_t doublings_;
    Column columns_[most_columns];
};
} // namespace ode_predictive_space::recording

#endif
