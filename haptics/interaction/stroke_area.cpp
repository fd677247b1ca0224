#include "haptics/interaction/stroke_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace marsview {
namespace {

// Cells over the reach whose corners are probed.
constexpr std::size_t kProbeColumns = 32;
constexpr std::size_t kProbeRows = 24;
// Of the picture's width and height, on each side: the hand trails its aim by some millimeters, and
// the terrain between two probes may rise.
constexpr double kMarginShare = 0.06;

// Whether a probe is well inside the picture, and where.
struct Probe {
    bool is_inside = false;
    PixelPoint pixel;
};
using Probes =
    std::array<std::array<Probe, kProbeColumns + 1>, kProbeRows + 1>; // of cells' corners

struct CellRectangle {
    std::size_t column = 0;
    std::size_t row = 0;
    std::size_t columns = 0; // in cells
    std::size_t rows = 0;
};

// A corner of the cells over a rectangle, level with the device's origin.
WorkspacePoint probeIn(const WorkspaceBox& box, std::size_t column, std::size_t row)
{
    return {
        box.low.x + (box.high.x - box.low.x) * static_cast<double>(column) / kProbeColumns,
        box.low.y + (box.high.y - box.low.y) * static_cast<double>(row) / kProbeRows,
        0.0,
    };
}

// Pixels that a cell takes up in the picture: half the cross product of its diagonals.
double pixelsOf(const Probes& probes, std::size_t column, std::size_t row)
{
    const PixelPoint a = probes[row][column].pixel;
    const PixelPoint b = probes[row + 1][column + 1].pixel;
    const PixelPoint c = probes[row][column + 1].pixel;
    const PixelPoint d = probes[row + 1][column].pixel;
    return 0.5 * std::abs((b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x));
}

// Of cells all of whose corners are inside, the rectangle with the most pixels: in a tilted view
// the far terrain is wide, but small in the picture.
CellRectangle largestRectangle(const Probes& probes)
{
    CellRectangle best;
    double best_pixels = 0.0;
    for (std::size_t first = 0; first < kProbeRows; ++first) {
        // Of the cells from row `first` to `row` in each column; negative: one of them is outside.
        std::array<double, kProbeColumns> pixels{};
        for (std::size_t row = first; row < kProbeRows; ++row) {
            for (std::size_t column = 0; column < kProbeColumns; ++column) {
                const bool is_full = pixels[column] >= 0.0 && probes[row][column].is_inside &&
                                     probes[row][column + 1].is_inside &&
                                     probes[row + 1][column].is_inside &&
                                     probes[row + 1][column + 1].is_inside;
                pixels[column] = is_full ? pixels[column] + pixelsOf(probes, column, row) : -1.0;
            }
            std::size_t begin = 0;
            double sum = 0.0;
            for (std::size_t column = 0; column < kProbeColumns; ++column) {
                if (pixels[column] < 0.0) {
                    begin = column + 1;
                    sum = 0.0;
                    continue;
                }
                sum += pixels[column];
                if (sum > best_pixels) {
                    best_pixels = sum;
                    best = {begin, first, column - begin + 1, row - first + 1};
                }
            }
        }
    }
    return best;
}

// The rectangle within `reach` all of whose probes are well inside the picture.
std::optional<WorkspaceBox>
probedArea(const WorkspaceBox& reach, const Viewport& viewport, const TerrainPixel& pixel_at)
{
    const double left = kMarginShare * viewport.width;
    const double top = kMarginShare * viewport.height;
    Probes probes{};
    for (std::size_t row = 0; row <= kProbeRows; ++row) {
        for (std::size_t column = 0; column <= kProbeColumns; ++column) {
            if (const auto pixel = pixel_at(probeIn(reach, column, row))) {
                const bool is_inside = pixel->x >= left && pixel->x <= viewport.width - left &&
                                       pixel->y >= top && pixel->y <= viewport.height - top;
                probes[row][column] = {is_inside, *pixel};
            }
        }
    }
    const CellRectangle found = largestRectangle(probes);
    if (found.columns == 0) {
        return std::nullopt;
    }
    WorkspaceBox area = reach;
    const WorkspacePoint low = probeIn(reach, found.column, found.row);
    const WorkspacePoint high =
        probeIn(reach, found.column + found.columns, found.row + found.rows);
    area.low.x = low.x;
    area.low.y = low.y;
    area.high.x = high.x;
    area.high.y = high.y;
    return area;
}

} // namespace

std::optional<WorkspaceBox>
strokeArea(const WorkspaceBox& reach, const Viewport& viewport, const TerrainPixel& pixel_at)
{
    // Once more within what was found: on rough terrain a ridge between two probes may leave the
    // picture.
    const std::optional<WorkspaceBox> found = probedArea(reach, viewport, pixel_at);
    return found ? std::optional(probedArea(*found, viewport, pixel_at).value_or(*found))
                 : std::nullopt;
}

double highestIn(const WorkspaceBox& rectangle,
                 const std::function<double(const WorkspacePoint&)>& height_at)
{
    double highest = rectangle.low.z;
    for (std::size_t row = 0; row <= kProbeRows; ++row) {
        for (std::size_t column = 0; column <= kProbeColumns; ++column) {
            const double height = height_at(probeIn(rectangle, column, row));
            highest = height > highest ? height : highest; // not for NaN
        }
    }
    return highest;
}

} // namespace marsview
