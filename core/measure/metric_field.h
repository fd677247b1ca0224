// Lengths and areas of the grid on the ground.
#pragma once

#include "core/measure/grid_field.h"
#include "core/measure/measured_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>

namespace marsview {

/// Products of the ground vectors of one column and one row, in square meters. Unlike the vectors'
/// components, they are smooth at a pole.
struct GroundMetric {
    double columns = 0.0;
    double mixed = 0.0;
    double rows = 0.0;

    double cellArea() const { return std::sqrt(std::max(0.0, columns * rows - mixed * mixed)); }
    /// Of a cell of this size whose sides rise by these heights.
    double surface(double width, double height, double rise, double rise_down) const
    {
        const double a = columns * width * width + rise * rise;
        const double b = rows * height * height + rise_down * rise_down;
        const double ab = mixed * width * height + rise * rise_down;
        return std::sqrt(std::max(0.0, a * b - ab * ab));
    }
};

/// Exact, or interpolated to seven digits where computing it everywhere takes long. For one thread;
/// must not outlive the terrain.
class MetricField {
public:
    /// `low` and `high` are the corners of the measured part.
    static std::unique_ptr<MetricField>
    of(const MeasuredTerrain& terrain, GridPoint low, GridPoint high);

    explicit MetricField(const MeasuredTerrain& terrain)
        : terrain_(terrain)
    {}

    GroundMetric at(GridPoint grid);

private:
    static constexpr std::size_t kRows = 64;
    struct Row {
        double row = std::numeric_limits<double>::quiet_NaN();
        GroundMetric metric{};
    };

    const MeasuredTerrain& terrain_;
    bool is_by_row_ = false;
    std::optional<GridField<3>> table_;
    std::array<Row, kRows> rows_;
};

} // namespace marsview
