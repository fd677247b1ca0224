#include "core/measure/polygon_outline.h"

#include "core/measure/terrain_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

class OutlineMaker {
public:
    explicit OutlineMaker(const MeasuredTerrain& terrain)
        : terrain_(terrain)
        , bottom_(terrain.rowLine(terrain.cellRows()))
    {}

    Status add(const GroundLine& line)
    {
        for (const GridCurve& curve : gridCurves(terrain_, line)) {
            if (!curve.is_on_map && !curve.is_along_pole) {
                return Error{ErrorCode::OutOfRange,
                             "an edge of the polygon leaves the map's projection; choose positions "
                             "on the map"};
            }
            addCurve(curve);
        }
        return Done{};
    }

    PolygonOutline finish() &&
    {
        if (has_begun_) {
            const double turns = turnsBetween(first_column_, last_column_);
            joinAt(first_column_ + turns);
            outline_.turn_columns = turns;
        }
        return std::move(outline_);
    }

private:
    // Columns of whole turns from `column` to near `other`.
    double turnsBetween(double column, double other) const
    {
        const double period = terrain_.period();
        return period > 0.0 ? period * std::round((other - column) / period) : 0.0;
    }

    // Where an edge ends and the next one begins at a pole that is a row of the grid, the outline
    // continues along that row.
    void joinAt(double column)
    {
        constexpr double kSame = 1e-3; // samples
        if (terrain_.period() > 0.0 && std::abs(column - last_column_) > kSame) {
            addCut({.column = {last_column_, column - last_column_, 0.0, 0.0},
                    .row = {last_row_, 0.0, 0.0, 0.0}},
                   0.0);
        }
        last_column_ = column;
    }

    void addCurve(const GridCurve& curve)
    {
        // Continue the columns of the edge before, so that the area is that of a closed line.
        const double begin = curve.at(0.0).column;
        const double jump = has_begun_ ? turnsBetween(begin, last_column_) : 0.0;
        if (has_begun_) {
            joinAt(begin + jump);
        } else {
            first_column_ = begin;
        }
        addCut(curve, jump);
        last_column_ = curve.at(1.0).column + jump;
        last_row_ = curve.at(1.0).row;
        has_begun_ = true;
    }

    void addCut(const GridCurve& curve, double jump)
    {
        findCellCuts(terrain_, curve, cuts_);
        for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
            addBent(curve, cuts_[i], cuts_[i + 1], jump, 0);
        }
    }

    static GridPoint gridAt(const GridCurve& curve, const CellCut& cut)
    {
        const GridPoint grid = curve.at(cut.t);
        return {std::isnan(cut.column) ? grid.column : cut.column,
                std::isnan(cut.row) ? grid.row : cut.row};
    }

    // Halved until straight within 1e-6 of a sample.
    void addBent(
        const GridCurve& curve, const CellCut& begin, const CellCut& end, double jump, int depth)
    {
        const GridPoint a = gridAt(curve, begin);
        const GridPoint b = gridAt(curve, end);
        const CellCut half{.t = 0.5 * (begin.t + end.t)};
        const GridPoint m = gridAt(curve, half);
        constexpr double kStraight = 1e-6;
        constexpr int kDepthMax = 12;
        const double length = std::hypot(b.column - a.column, b.row - a.row);
        const double sagitta = length > 0.0 ? std::abs((m.column - a.column) * (b.row - a.row) -
                                                       (m.row - a.row) * (b.column - a.column)) /
                                                  length
                                            : 0.0;
        if (depth < kDepthMax && sagitta > kStraight) {
            addBent(curve, begin, half, jump, depth + 1);
            addBent(curve, half, end, jump, depth + 1);
            return;
        }
        addStraight(a, b, m, jump);
    }

    void addStraight(const GridPoint& a, const GridPoint& b, const GridPoint& middle, double jump)
    {
        outline_.area += 0.5 * ((a.column + jump) * b.row - (b.column + jump) * a.row);
        for (const GridPoint& point : {a, b}) {
            outline_.low.column = std::min(outline_.low.column, point.column + jump);
            outline_.high.column = std::max(outline_.high.column, point.column + jump);
            outline_.low.row = std::min(outline_.low.row, point.row);
            outline_.high.row = std::max(outline_.high.row, point.row);
        }
        const auto place = terrain_.placeInColumns(middle.column);
        if (!place || middle.row >= bottom_ || a.column == b.column) {
            return; // nothing of the map is below
        }
        const double left = terrain_.columnLine(place->column);
        const double width = terrain_.columnLine(place->column + 1) - left;
        // The column of the middle, in the turn that the place is in.
        const double offset = middle.column - (left + place->u * width);
        const auto share = [&](double column) {
            return std::clamp((column - offset - left) / width, 0.0, 1.0);
        };
        EdgePart part{.column = place->column, .u0 = share(a.column), .u1 = share(b.column)};
        // Ends on the same line of the grid meet exactly.
        if (middle.row < 0.0) {
            part.is_above = true;
        } else {
            const auto cell = terrain_.placeOf(middle);
            if (!cell) {
                return;
            }
            part.row = cell->row;
            const double top = terrain_.rowLine(cell->row);
            const double height = terrain_.rowLine(cell->row + 1) - top;
            part.v0 = std::clamp((a.row - top) / height, 0.0, 1.0);
            part.v1 = std::clamp((b.row - top) / height, 0.0, 1.0);
        }
        outline_.parts.push_back(part);
    }

    const MeasuredTerrain& terrain_;
    double bottom_;
    std::vector<CellCut> cuts_;
    PolygonOutline outline_;
    double first_column_ = 0.0;
    double last_column_ = 0.0;
    double last_row_ = 0.0;
    bool has_begun_ = false;
};

} // namespace

Result<PolygonOutline> outlineOf(const MeasuredTerrain& terrain,
                                 std::span<const GroundPosition> vertices)
{
    OutlineMaker maker(terrain);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Status status =
            maker.add(terrain.ground().line(vertices[i], vertices[(i + 1) % vertices.size()]));
        if (!status) {
            return status.error();
        }
    }
    return std::move(maker).finish();
}

} // namespace marsview
