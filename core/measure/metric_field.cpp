#include "core/measure/metric_field.h"

#include "core/measure/grid_steps.h"

namespace marsview {
namespace {

std::optional<GroundMetric> metricAt(const MeasuredTerrain& terrain, GridPoint grid)
{
    const auto s = gridSteps(terrain, grid);
    if (!s) {
        return std::nullopt;
    }
    return GroundMetric{
        s->east_per_column * s->east_per_column + s->north_per_column * s->north_per_column,
        s->east_per_column * s->east_per_row + s->north_per_column * s->north_per_row,
        s->east_per_row * s->east_per_row + s->north_per_row * s->north_per_row};
}

} // namespace

std::unique_ptr<MetricField>
MetricField::of(const MeasuredTerrain& terrain, GridPoint low, GridPoint high)
{
    auto field = std::make_unique<MetricField>(terrain);
    const GeoTransform::Terms& t = terrain.georeference().transform().terms();
    const bool is_upright = t[2] == 0.0 && t[4] == 0.0;
    field->is_by_row_ = !terrain.ground().ellipsoid() || (is_upright && terrain.period() > 0.0);
    if (!field->is_by_row_) {
        constexpr double kTolerance = 1e-7;
        field->table_ = GridField<3>::of(
            low, high, kTolerance, [&](GridPoint grid) -> std::optional<std::array<double, 3>> {
                const auto metric = metricAt(terrain, grid);
                return metric
                           ? std::optional(std::array{metric->columns, metric->mixed, metric->rows})
                           : std::nullopt;
            });
    }
    return field;
}

GroundMetric MetricField::at(GridPoint grid)
{
    if (table_) {
        const auto v = table_->at(grid);
        return {v[0], v[1], v[2]};
    }
    // Where the projection ends, cells have no area.
    if (!is_by_row_) {
        return metricAt(terrain_, grid).value_or(GroundMetric{});
    }
    Row& known = rows_[static_cast<std::size_t>(std::llround(grid.row * 3.0)) % kRows];
    if (known.row != grid.row) {
        const double center = 0.5 * static_cast<double>(terrain_.georeference().columns());
        known = {grid.row, metricAt(terrain_, {center, grid.row}).value_or(GroundMetric{})};
    }
    return known.metric;
}

} // namespace marsview
