#include "core/view/map_preview.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace marsview {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
constexpr SceneFrame kNorthUp{.origin = {}, .east_per_column = 10.0, .north_per_row = -10.0};

struct Grid {
    std::size_t columns;
    std::size_t rows;
    std::vector<float> heights_m;

    GridView<const float> view() const { return {heights_m.data(), columns, rows}; }
    std::optional<double> at(std::ptrdiff_t column, std::ptrdiff_t row) const
    {
        if (column < 0 || row < 0 || column >= static_cast<std::ptrdiff_t>(columns) ||
            row >= static_cast<std::ptrdiff_t>(rows)) {
            return std::nullopt;
        }
        const float h =
            heights_m[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
        return std::isnan(h) ? std::nullopt : std::optional<double>(h);
    }
};

PreviewStyle grays()
{
    PreviewStyle style;
    for (std::size_t i = 0; i < 256; ++i) {
        const auto value = static_cast<std::uint8_t>(i);
        style.ramp[i] = {value, value, value};
    }
    style.tint_range = {.minimum_m = 0.0, .maximum_m = 100.0};
    return style;
}

int red(const MapPreview& preview, std::size_t column, std::size_t row)
{
    return preview.rgba[(row * preview.columns + column) * 4];
}

// The same computed differently: points in space, and the cross product of the lines between
// neighbors.
double expectedRed(const Grid& grid,
                   const SceneFrame& frame,
                   const PreviewStyle& style,
                   std::ptrdiff_t c,
                   std::ptrdiff_t r)
{
    const auto tangent_along = [&](std::ptrdiff_t dc, std::ptrdiff_t dr) {
        std::ptrdiff_t from = grid.at(c - dc, r - dr) ? -1 : 0;
        std::ptrdiff_t to = grid.at(c + dc, r + dr) ? 1 : 0;
        double rise = 0.0;
        if (from == to) { // without neighbors: level
            to = 1;
        } else {
            rise = *grid.at(c + to * dc, r + to * dr) - *grid.at(c + from * dc, r + from * dr);
        }
        const auto step = [&](std::ptrdiff_t k) {
            return frame.toScene({static_cast<double>(c + k * dc), static_cast<double>(r + k * dr)},
                                 0.0);
        };
        Vec3 along = step(to) - step(from);
        along.z = rise * style.exaggeration;
        return along;
    };
    Vec3 normal = normalized(cross(tangent_along(1, 0), tangent_along(0, 1)));
    if (normal.z < 0.0) {
        normal = -normal;
    }
    const double azimuth = style.light_azimuth.radians();
    const double altitude = style.light_altitude.radians();
    const Vec3 light{std::sin(azimuth) * std::cos(altitude), std::cos(azimuth) * std::cos(altitude),
                     std::sin(altitude)};
    const double share = std::clamp((*grid.at(c, r) - style.tint_range.minimum_m) /
                                        (style.tint_range.maximum_m - style.tint_range.minimum_m),
                                    0.0, 1.0);
    const double shade = 0.28 + 0.84 * std::max(0.0, dot(normal, light));
    return std::min(255.0, share * 255.0 * shade); // the ramp is gray and linear
}

TEST(MapPreview, MatchesNormalsFromCrossProducts)
{
    test::Random random;
    for (int i = 0; i < 300; ++i) {
        Grid grid{1 + random.below(12), 1 + random.below(12), {}};
        for (std::size_t k = 0; k < grid.columns * grid.rows; ++k) {
            grid.heights_m.push_back(
                random.chance(0.15) ? kVoid : static_cast<float>(random.uniform(-20.0, 120.0)));
        }
        const SceneFrame frame{.origin = {1.0, 2.0},
                               .east_per_column = random.uniform(5.0, 40.0),
                               .east_per_row = random.uniform(-4.0, 4.0),
                               .north_per_column = random.uniform(-4.0, 4.0),
                               .north_per_row =
                                   random.uniform(5.0, 40.0) * (random.chance(0.5) ? 1.0 : -1.0)};
        PreviewStyle style = grays();
        style.exaggeration = random.uniform(0.1, 5.0);
        style.light_azimuth = Angle::degrees(random.uniform(0.0, 360.0));
        style.light_altitude = Angle::degrees(random.uniform(5.0, 90.0));
        const MapPreview preview = mapPreview(grid.view(), frame, style);
        for (std::size_t r = 0; r < grid.rows; ++r) {
            for (std::size_t c = 0; c < grid.columns; ++c) {
                const auto column = static_cast<std::ptrdiff_t>(c);
                const auto row = static_cast<std::ptrdiff_t>(r);
                const std::uint8_t* pixel = preview.rgba.data() + (r * grid.columns + c) * 4;
                if (!grid.at(column, row)) {
                    ASSERT_EQ(pixel[0] + pixel[1] + pixel[2] + pixel[3], 0);
                    continue;
                }
                ASSERT_EQ(pixel[3], 255);
                ASSERT_NEAR(pixel[0], expectedRed(grid, frame, style, column, row), 0.5 + 1e-6);
            }
        }
    }
}

TEST(MapPreview, FlatTerrainHasOneColor)
{
    const Grid grid{5, 4, std::vector<float>(20, 50.0F)};
    PreviewStyle style = grays();
    const int expected = static_cast<int>(
        std::lround(127.5 * (0.28 + 0.84 * std::sin(Angle::degrees(45.0).radians()))));
    const MapPreview preview = mapPreview(grid.view(), kNorthUp, style);
    for (std::size_t i = 0; i < 20; ++i) {
        EXPECT_EQ(red(preview, i % 5, i / 5), expected);
    }
    style.tint_range = {.minimum_m = 50.0, .maximum_m = 50.0};
    EXPECT_EQ(red(mapPreview(grid.view(), kNorthUp, style), 2, 2), expected)
        << "equal elevations get the middle of the ramp";
}

TEST(MapPreview, IsLitFromTheNorthwestOnEveryRaster)
{
    constexpr std::array<GridPoint, 9> kNine{
        {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}}};
    // A slope that falls to the north-west, on rasters in all four orientations.
    for (const double east : {10.0, -10.0}) {
        for (const double north : {10.0, -10.0}) {
            const SceneFrame frame{.origin = {}, .east_per_column = east, .north_per_row = north};
            Grid to_light{3, 3, {}};
            Grid from_light{3, 3, {}};
            for (int i = 0; i < 9; ++i) {
                const ScenePoint p = frame.toScene(kNine[static_cast<std::size_t>(i)], 0.0);
                to_light.heights_m.push_back(static_cast<float>(50.0 + (p.x - p.y) * 0.5));
                from_light.heights_m.push_back(static_cast<float>(50.0 - (p.x - p.y) * 0.5));
            }
            PreviewStyle style = grays();
            style.tint_range = {.minimum_m = 0.0, .maximum_m = 0.0};
            EXPECT_GT(red(mapPreview(to_light.view(), frame, style), 1, 1),
                      red(mapPreview(from_light.view(), frame, style), 1, 1) + 50);
        }
    }
}

TEST(MapPreview, MakesOnlyVoidsTransparent)
{
    const Grid grid{2, 2, {10.0F, kVoid, 20.0F, 30.0F}};
    const MapPreview preview = mapPreview(grid.view(), kNorthUp, grays());
    EXPECT_EQ(preview.rgba[3], 255);
    EXPECT_EQ(preview.rgba[7], 0);
    EXPECT_EQ(preview.rgba[11], 255);
    EXPECT_EQ(preview.rgba[15], 255);
}

TEST(MapPreview, IsEmptyForAnEmptyGrid)
{
    const MapPreview preview = mapPreview({}, kNorthUp, grays());
    EXPECT_TRUE(preview.rgba.empty());
}

TEST(PreviewFrame, CoversTheRasterEdgeToEdge)
{
    const SceneFrame frame{.origin = {999.5, 499.5},
                           .east_per_column = 30.0,
                           .east_per_row = 4.0,
                           .north_per_column = -3.0,
                           .north_per_row = -25.0};
    const SceneFrame preview = previewFrame(frame, 2000, 1000, 220, 110);
    for (const GridPoint corner : {GridPoint{0.0, 0.0}, GridPoint{1.0, 0.0}, GridPoint{0.0, 1.0},
                                   GridPoint{1.0, 1.0}, GridPoint{0.5, 0.5}}) {
        const ScenePoint a =
            frame.toScene({corner.column * 2000 - 0.5, corner.row * 1000 - 0.5}, 0.0);
        const ScenePoint b =
            preview.toScene({corner.column * 220 - 0.5, corner.row * 110 - 0.5}, 0.0);
        EXPECT_LT(length(a - b), 1e-6);
    }
}

} // namespace
} // namespace marsview
