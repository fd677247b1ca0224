// Smooth functions of the position on the grid, tabulated.
#pragma once

#include "core/geo/frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace marsview {

/// N smooth functions over a rectangle of the grid: values at nodes, cubic in between. Placing
/// every sample through PROJ would take a hundred times longer.
template <std::size_t N>
class GridField {
public:
    using Values = std::array<double, N>;
    using Function = std::function<std::optional<Values>(GridPoint)>;

    /// Halves the distance of nodes until the values between them are within `tolerance` of the
    /// largest magnitude of all functions, which have one unit. Empty where `function` is, anywhere
    /// in the rectangle, and if kCellsMax cells between nodes along a side do not suffice.
    static std::optional<GridField>
    of(GridPoint low, GridPoint high, double tolerance, const Function& function)
    {
        // A whole turn of longitude needs 512 for 1e-8.
        constexpr std::size_t kCellsMax = 512;
        for (std::size_t count = 4; count <= kCellsMax; count *= 2) {
            std::optional<GridField> field = tabulated(low, high, count, function);
            if (!field) {
                return std::nullopt;
            }
            const std::optional<bool> is_fine = field->isWithin(tolerance, function);
            if (!is_fine) {
                return std::nullopt;
            }
            if (*is_fine) {
                return field;
            }
        }
        return std::nullopt;
    }

    Values at(GridPoint grid) const
    {
        std::array<double, 4> across{};
        std::array<double, 4> down{};
        const std::size_t i = weights((grid.column - low_.column) / step_.column, across);
        const std::size_t j = weights((grid.row - low_.row) / step_.row, down);
        Values sum{};
        for (std::size_t b = 0; b < 4; ++b) {
            for (std::size_t a = 0; a < 4; ++a) {
                const Values& node = nodes_[(j + b) * (count_ + 1) + i + a];
                for (std::size_t k = 0; k < N; ++k) {
                    sum[k] += across[a] * down[b] * node[k];
                }
            }
        }
        return sum;
    }

private:
    static std::optional<GridField>
    tabulated(GridPoint low, GridPoint high, std::size_t count, const Function& function)
    {
        GridField field;
        field.low_ = low;
        field.count_ = count;
        constexpr double kSpanMin = 1e-9; // a rectangle may be a line
        const auto cells = static_cast<double>(count);
        field.step_ = {std::max(high.column - low.column, kSpanMin) / cells,
                       std::max(high.row - low.row, kSpanMin) / cells};
        for (std::size_t j = 0; j <= count; ++j) {
            for (std::size_t i = 0; i <= count; ++i) {
                const auto values =
                    function(field.node(static_cast<double>(i), static_cast<double>(j)));
                if (!values) {
                    return std::nullopt;
                }
                field.nodes_.push_back(*values);
            }
        }
        return field;
    }

    GridPoint node(double i, double j) const
    {
        return {low_.column + i * step_.column, low_.row + j * step_.row};
    }

    std::optional<bool> isWithin(double tolerance, const Function& function) const
    {
        double largest = 0.0;
        for (const Values& values : nodes_) {
            for (const double value : values) {
                largest = std::max(largest, std::abs(value));
            }
        }
        // In the middle of a cell at the border, where the cubic is one-sided, and elsewhere.
        for (std::size_t j = 0; j < count_; j += std::max<std::size_t>(1, count_ / 8)) {
            for (std::size_t i = 0; i < count_; i += std::max<std::size_t>(1, count_ / 8)) {
                const GridPoint middle =
                    node(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5);
                const auto truth = function(middle);
                if (!truth) {
                    return std::nullopt;
                }
                const Values found = at(middle);
                for (std::size_t k = 0; k < N; ++k) {
                    if (!(std::abs(found[k] - (*truth)[k]) <= tolerance * largest)) {
                        return false;
                    }
                }
            }
        }
        return true;
    }

    // Lagrange's weights of four consecutive nodes; returns the first.
    std::size_t weights(double x, std::array<double, 4>& w) const
    {
        const double last = static_cast<double>(count_ - 3);
        const double first = std::clamp(std::floor(x) - 1.0, 0.0, last);
        const double t = x - first;
        w[0] = -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0;
        w[1] = t * (t - 2.0) * (t - 3.0) / 2.0;
        w[2] = -t * (t - 1.0) * (t - 3.0) / 2.0;
        w[3] = t * (t - 1.0) * (t - 2.0) / 6.0;
        return static_cast<std::size_t>(first);
    }

    GridPoint low_;
    GridPoint step_;
    std::size_t count_ = 0;
    std::vector<Values> nodes_;
};

} // namespace marsview
