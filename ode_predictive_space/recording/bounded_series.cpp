#include "ode_predictive_space/recording/bounded_series.h"

#include <algorithm>

namespace ode_predictive_space::recording
{
void BoundedSeries::add(double value)
{
    if (values_ / values_per_column() >= most_columns)
        merge_neighbours();
    Column &column = columns_[std::min<std::uint64_t>(values_ / values_per_column(), most_columns - 1)];
    const auto rounded = static_cast<float>(value);
    const bool is_new = values_ % values_per_column() == 0;
    column = is_new ? Column{rounded, rounded} : Column{column.sum + rounded, std::max(column.largest, rounded)};
    ++values_;
}

void BoundedSeries::merge_neighbours()
{
    for (std::size_t i = 0; i < most_columns / 2; ++i)
    {
        const Column &first = columns_[2 * i];
        const Column &second = columns_[2 * i + 1];
        columns_[i] = {first.sum + second.sum, std::max(first.largest, second.largest)};
    }
    ++doublings_;
}

std::size_t BoundedSeries::columns() const
{
    const std::uint64_t per_column = values_per_column();
    const std::uint64_t all = values_ / per_column + (values_ % per_column != 0 ? 1 : 0);
    return static_cast<std::size_t>(std::min<std::uint64_t>(all, most_columns));
}

double BoundedSeries::mean(std::size_t column) const
{
    const std::uint64_t per_column = values_per_column();
    const std::uint64_t before = column * per_column;
    return static_cast<double>(columns_[column].sum) / static_cast<double>(std::min(values_ - before, per_column));
}
} // namespace ode_predictive_space::recording
