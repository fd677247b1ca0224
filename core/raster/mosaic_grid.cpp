#include "core/raster/mosaic_grid.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numeric>

namespace marsview {
namespace {

// Headers round pixel sizes and corners to a few digits.
constexpr double kOffGridMax = 0.05; // of a pixel

// Rectangles of a pattern finer than this are not counted.
constexpr std::size_t kPatternMax = std::size_t{1} << 26;

// A part's first column and row, counted from those of the first part.
struct Offset {
    std::int64_t column = 0;
    std::int64_t row = 0;
};

bool isWhole(double number)
{
    return std::abs(number - std::round(number)) <= kOffGridMax;
}

Result<Offset> offsetOf(const MosaicPart& part, const MosaicPart& first)
{
    const GeoTransform::Terms& terms = part.transform.terms();
    const GeoTransform::Terms& grid = first.transform.terms();
    const auto refuse = [&part](const std::string& why) {
        return Error{ErrorCode::Invalid, fmt::format("{} {}", part.name, why)};
    };
    if (terms[2] != 0.0 || terms[4] != 0.0) {
        return refuse("is rotated");
    }
    const auto differs = [](double a, double b, std::size_t count) {
        return !(std::abs(a - b) * static_cast<double>(count) <= kOffGridMax * std::abs(b));
    };
    if (differs(terms[1], grid[1], part.size.columns) ||
        differs(terms[5], grid[5], part.size.rows)) {
        return refuse(fmt::format("has pixels of {:.9g} × {:.9g}, {} of {:.9g} × {:.9g}", terms[1],
                                  terms[5], first.name, grid[1], grid[5]));
    }
    const double column = (terms[0] - grid[0]) / grid[1];
    const double row = (terms[3] - grid[3]) / grid[5];
    if (!isWhole(column) || !isWhole(row)) {
        return refuse(fmt::format("lies {:.3g} columns and {:.3g} rows off the grid of {}",
                                  column - std::round(column), row - std::round(row), first.name));
    }
    return Offset{std::llround(column), std::llround(row)};
}

struct ColumnSpan {
    std::int64_t first = 0;
    std::int64_t end = 0;
};

ColumnSpan columnsOf(const std::vector<MosaicPart>& parts, const std::vector<Offset>& offsets)
{
    ColumnSpan all{offsets.front().column, offsets.front().column};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        all.first = std::min(all.first, offsets[i].column);
        all.end =
            std::max(all.end, offsets[i].column + static_cast<std::int64_t>(parts[i].size.columns));
    }
    return all;
}

// Moves parts by a turn so that the widest gap on the circle lies outside, if that makes the mosaic
// narrower.
void closeAcrossSeam(const std::vector<MosaicPart>& parts,
                     std::int64_t turn_columns,
                     std::vector<Offset>& offsets)
{
    std::vector<Offset> moved = offsets;
    for (Offset& offset : moved) {
        offset.column = (offset.column % turn_columns + turn_columns) % turn_columns;
    }
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&moved](std::size_t a, std::size_t b) { return moved[a].column < moved[b].column; });
    const auto end_of = [&](std::size_t i) {
        return moved[i].column + static_cast<std::int64_t>(parts[i].size.columns);
    };
    std::int64_t end = end_of(order.front());
    std::int64_t widest = 0;
    std::int64_t seam = 0; // parts that begin before it move by a turn
    for (const std::size_t i : order) {
        if (moved[i].column - end > widest) {
            widest = moved[i].column - end;
            seam = moved[i].column;
        }
        end = std::max(end, end_of(i));
    }
    if (moved[order.front()].column + turn_columns - end >= widest) {
        seam = 0;
    }
    for (Offset& offset : moved) {
        offset.column += offset.column < seam ? turn_columns : 0;
    }
    const ColumnSpan as_given = columnsOf(parts, offsets);
    const ColumnSpan closed = columnsOf(parts, moved);
    if (closed.end - closed.first < as_given.end - as_given.first) {
        offsets = std::move(moved);
    }
}

// The fraction of the rectangle covered by windows, counted on the pattern of all their edges.
double coveredShare(const std::vector<GridWindow>& windows, const GridSize& size)
{
    std::vector<std::size_t> columns{0, size.columns};
    std::vector<std::size_t> rows{0, size.rows};
    for (const GridWindow& window : windows) {
        columns.insert(columns.end(), {window.column, window.column + window.columns});
        rows.insert(rows.end(), {window.row, window.row + window.rows});
    }
    for (std::vector<std::size_t>* edges : {&columns, &rows}) {
        std::sort(edges->begin(), edges->end());
        edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
    }
    const std::size_t across = columns.size() - 1;
    const std::size_t down = rows.size() - 1;
    const double all = static_cast<double>(size.columns) * static_cast<double>(size.rows);
    double covered = 0.0;
    if (across * down > kPatternMax) { // no regular pattern: assume no overlap
        for (const GridWindow& window : windows) {
            covered += static_cast<double>(window.columns) * static_cast<double>(window.rows);
        }
        return std::min(covered / all, std::nextafter(1.0, 0.0));
    }
    std::vector<bool> is_covered(across * down);
    const auto index = [](const std::vector<std::size_t>& edges, std::size_t edge) {
        return static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), edge) -
                                        edges.begin());
    };
    std::uint64_t count = 0;
    for (const GridWindow& window : windows) {
        const std::size_t last_column = index(columns, window.column + window.columns);
        const std::size_t last_row = index(rows, window.row + window.rows);
        for (std::size_t r = index(rows, window.row); r < last_row; ++r) {
            for (std::size_t c = index(columns, window.column); c < last_column; ++c) {
                if (!is_covered[r * across + c]) {
                    is_covered[r * across + c] = true;
                    count += std::uint64_t{columns[c + 1] - columns[c]} * (rows[r + 1] - rows[r]);
                }
            }
        }
    }
    const bool is_whole = count == std::uint64_t{size.columns} * size.rows;
    return is_whole ? 1.0 : static_cast<double>(count) / all;
}

} // namespace

Result<MosaicGrid> layOutMosaic(const std::vector<MosaicPart>& parts, std::optional<double> turn)
{
    MARSVIEW_CHECK(!parts.empty());
    std::vector<Offset> offsets;
    offsets.reserve(parts.size());
    for (const MosaicPart& part : parts) {
        Result<Offset> offset = offsetOf(part, parts.front());
        if (!offset) {
            return std::move(offset).error();
        }
        offsets.push_back(*offset);
    }
    const GeoTransform::Terms& first = parts.front().transform.terms();
    if (turn) {
        const double turn_columns = *turn / std::abs(first[1]);
        if (isWhole(turn_columns) && turn_columns >= 1.0) {
            closeAcrossSeam(parts, std::llround(turn_columns), offsets);
        }
    }
    const ColumnSpan columns = columnsOf(parts, offsets);
    std::int64_t first_row = offsets.front().row;
    std::int64_t end_row = first_row;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        first_row = std::min(first_row, offsets[i].row);
        end_row = std::max(end_row, offsets[i].row + static_cast<std::int64_t>(parts[i].size.rows));
    }
    MosaicGrid grid;
    grid.size = {static_cast<std::size_t>(columns.end - columns.first),
                 static_cast<std::size_t>(end_row - first_row)};
    GeoTransform::Terms terms = first;
    terms[0] += static_cast<double>(columns.first) * first[1];
    terms[3] += static_cast<double>(first_row) * first[5];
    for (std::size_t i = 0; i < parts.size(); ++i) {
        grid.places.push_back({static_cast<std::size_t>(offsets[i].column - columns.first),
                               static_cast<std::size_t>(offsets[i].row - first_row),
                               parts[i].size.columns, parts[i].size.rows});
        // Corners as stored in a file, without the rounding of a product.
        if (grid.places[i].column == 0) {
            const double turns =
                turn ? std::round((terms[0] - parts[i].transform.terms()[0]) / *turn) * *turn : 0.0;
            terms[0] = parts[i].transform.terms()[0] + turns;
        }
        if (grid.places[i].row == 0) {
            terms[3] = parts[i].transform.terms()[3];
        }
    }
    Result<GeoTransform> transform = GeoTransform::fromTerms(terms);
    if (!transform) {
        return std::move(transform).error();
    }
    grid.transform = *transform;
    grid.covered = coveredShare(grid.places, grid.size);
    return grid;
}

} // namespace marsview
