#include "core/view/map_preview.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace marsview {
namespace {

// As in the terrain's shader (ui/render/terrain_renderer.cpp), so that both look alike.
constexpr double kAmbient = 0.28;
constexpr double kDiffuse = 0.84;

struct Tint {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
};

// Interpolates between the ramp's colors, like a texture with linear filtering.
Tint tintAt(std::span<const Rgb8, 256> ramp, double share)
{
    const double position = std::clamp(share, 0.0, 1.0) * 255.0;
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min<std::size_t>(below + 1, 255);
    const double t = position - static_cast<double>(below);
    const auto mixed = [t](std::uint8_t a, std::uint8_t b) { return a + (b - a) * t; };
    return {mixed(ramp[below].red, ramp[above].red), mixed(ramp[below].green, ramp[above].green),
            mixed(ramp[below].blue, ramp[above].blue)};
}

// The rise from one element to the next around `here`. Void neighbors are NaN.
double rise(double before, double here, double after)
{
    if (std::isnan(before)) {
        return std::isnan(after) ? 0.0 : after - here;
    }
    return std::isnan(after) ? here - before : (after - before) / 2.0;
}

std::uint8_t byteFrom(double value)
{
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

} // namespace

SceneFrame previewFrame(const SceneFrame& frame,
                        std::size_t raster_columns,
                        std::size_t raster_rows,
                        std::size_t columns,
                        std::size_t rows)
{
    const double per_column = static_cast<double>(raster_columns) / static_cast<double>(columns);
    const double per_row = static_cast<double>(raster_rows) / static_cast<double>(rows);
    // Outer corners coincide: grid + 1/2 = (pixel + 1/2) × samples per pixel.
    return {.origin = {(frame.origin.column + 0.5) / per_column - 0.5,
                       (frame.origin.row + 0.5) / per_row - 0.5},
            .east_per_column = frame.east_per_column * per_column,
            .east_per_row = frame.east_per_row * per_row,
            .north_per_column = frame.north_per_column * per_column,
            .north_per_row = frame.north_per_row * per_row};
}

MapPreview
mapPreview(GridView<const float> heights_m, const SceneFrame& frame, const PreviewStyle& style)
{
    const std::size_t columns = heights_m.columns();
    const std::size_t rows = heights_m.rows();
    MapPreview preview{.columns = columns, .rows = rows, .rgba = {}};
    preview.rgba.resize(columns * rows * 4);
    const double determinant =
        frame.east_per_column * frame.north_per_row - frame.east_per_row * frame.north_per_column;
    const double level = std::cos(style.light_altitude.radians());
    const Vec3 light{level * std::sin(style.light_azimuth.radians()),
                     level * std::cos(style.light_azimuth.radians()),
                     std::sin(style.light_altitude.radians())};
    const double tinted_m = style.tint_range.maximum_m - style.tint_range.minimum_m;
    // NaN outside the grid, so that an edge is treated like the rim of a void.
    const auto height = [&](std::size_t column, std::size_t row) {
        return column < columns && row < rows ? static_cast<double>(heights_m(column, row))
                                              : std::nan("");
    };
    std::uint8_t* pixel = preview.rgba.data();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column, pixel += 4) {
            const double here = height(column, row);
            if (std::isnan(here)) {
                continue;
            }
            const double per_column =
                style.exaggeration * rise(height(column - 1, row), here, height(column + 1, row));
            const double per_row =
                style.exaggeration * rise(height(column, row - 1), here, height(column, row + 1));
            const double per_east =
                (per_column * frame.north_per_row - per_row * frame.north_per_column) / determinant;
            const double per_north =
                (per_row * frame.east_per_column - per_column * frame.east_per_row) / determinant;
            const Vec3 normal = normalized({-per_east, -per_north, 1.0});
            const double shade = kAmbient + kDiffuse * std::max(dot(normal, light), 0.0);
            const double share =
                tinted_m > 0.0 ? (here - style.tint_range.minimum_m) / tinted_m : 0.5;
            const Tint tint = tintAt(style.ramp, share);
            pixel[0] = byteFrom(tint.red * shade);
            pixel[1] = byteFrom(tint.green * shade);
            pixel[2] = byteFrom(tint.blue * shade);
            pixel[3] = 255;
        }
    }
    return preview;
}

} // namespace marsview
