#include "ui/overlay/body_overview.h"

#include "core/globe/body_camera.h"
#include "core/globe/sunlight.h"
#include "core/view/map_preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

constexpr double kDegreesPerPixel = 360.0 / static_cast<double>(kOverviewColumns);
constexpr int kOutlineSteps = 64; // a side of a raster

// Of the colors of the day: places in the night are still to be recognized.
constexpr double kOverviewNight = 0.35;
constexpr double kTwilight = 0.1; // sine of the sun's altitude on either side of the terminator

GeographicPoint placeOfPixel(std::size_t column, std::size_t row)
{
    return {.longitude =
                Angle::degrees(-180.0 + (static_cast<double>(column) + 0.5) * kDegreesPerPixel),
            .latitude = Angle::degrees(90.0 - (static_cast<double>(row) + 0.5) * kDegreesPerPixel)};
}

// The level whose blocks are about as large as a pixel on the equator.
std::size_t levelFor(const BodyTerrain& terrain)
{
    const BlockMeans& means = terrain.map()->analysis()->means;
    const double pixel_m =
        kDegreesPerPixel / 180.0 * std::numbers::pi * terrain.grid()->ellipsoid().equatorial_m;
    double block_m = terrain.map()->georeference().pixelHeightMeters() *
                     static_cast<double>(means.blockSamples());
    std::size_t level = 0;
    while (block_m < 0.7 * pixel_m && level + 1 < means.levelCount()) {
        block_m *= 2.0;
        ++level;
    }
    return level;
}

} // namespace

std::vector<float> overviewHeights(const BodyTerrain& terrain, JobMonitor& monitor)
{
    const BlockMeans& means = terrain.map()->analysis()->means;
    const std::size_t level = levelFor(terrain);
    const GridView<const float> heights_m = means.means(level);
    const double block = static_cast<double>(means.blockSamples()) * std::exp2(level);
    std::vector<float> result;
    result.reserve(kOverviewColumns * kOverviewRows);
    for (std::size_t row = 0; row < kOverviewRows; ++row) {
        if (monitor.isCanceled()) {
            return {};
        }
        for (std::size_t column = 0; column < kOverviewColumns; ++column) {
            const auto grid = terrain.gridAt(placeOfPixel(column, row));
            float height_m = std::numeric_limits<float>::quiet_NaN();
            if (grid) {
                const auto index = [block](double place, std::size_t count) {
                    return std::min(static_cast<std::size_t>(std::max(0.0, place / block)),
                                    count - 1);
                };
                height_m = heights_m(index(grid->column, heights_m.columns()),
                                     index(grid->row, heights_m.rows()));
            }
            result.push_back(height_m);
        }
    }
    return result;
}

std::vector<QPolygonF> outlineOf(const Georeference& georeference)
{
    const double right = static_cast<double>(georeference.columns() - 1);
    const double bottom = static_cast<double>(georeference.rows() - 1);
    const std::array<GridPoint, 5> corners{GridPoint{0.0, 0.0}, GridPoint{right, 0.0},
                                           GridPoint{right, bottom}, GridPoint{0.0, bottom},
                                           GridPoint{0.0, 0.0}};
    std::vector<QPolygonF> pieces(1);
    for (std::size_t side = 0; side + 1 < corners.size(); ++side) {
        if (georeference.wrapsAround() && side % 2 == 1) {
            pieces.emplace_back(); // a seam, not an end
            continue;
        }
        for (int i = 0; i <= kOutlineSteps; ++i) {
            const double share = static_cast<double>(i) / kOutlineSteps;
            const GridPoint& from = corners[side];
            const GridPoint& to = corners[side + 1];
            const auto place =
                georeference.toGeographic({from.column + share * (to.column - from.column),
                                           from.row + share * (to.row - from.row)});
            if (!place) {
                pieces.emplace_back();
                continue;
            }
            const QPointF point(std::remainder(place->longitude.degrees(), 360.0),
                                place->latitude.degrees());
            if (!pieces.back().isEmpty() &&
                std::abs(point.x() - pieces.back().last().x()) > 180.0) {
                pieces.emplace_back();
            }
            pieces.back() << point;
        }
    }
    std::erase_if(pieces, [](const QPolygonF& piece) { return piece.size() < 2; });
    return pieces;
}

SceneFrame overviewFrame()
{
    return {.origin = {180.0 / kDegreesPerPixel - 0.5, 90.0 / kDegreesPerPixel - 0.5},
            .east_per_column = kDegreesPerPixel,
            .north_per_row = -kDegreesPerPixel};
}

QImage overviewOf(const std::vector<float>& heights_m,
                  const ShownLayer& layer,
                  const TerrainLook& look,
                  double exaggeration,
                  double equator_m)
{
    if (heights_m.size() != kOverviewColumns * kOverviewRows) {
        return {};
    }
    SceneFrame frame = overviewFrame();
    frame.east_per_column *= equator_m / 360.0;
    frame.north_per_row *= equator_m / 360.0;
    const MapPreview preview =
        mapPreview(GridView<const float>(heights_m.data(), kOverviewColumns, kOverviewRows), frame,
                   {.ramp = sampledRamp(*layer.ramp),
                    .tint_range = colorRangeOf(layer),
                    .light_azimuth = look.light_azimuth,
                    .light_altitude = look.light_altitude,
                    .exaggeration = exaggeration});
    return QImage(preview.rgba.data(), static_cast<int>(preview.columns),
                  static_cast<int>(preview.rows), static_cast<int>(4 * preview.columns),
                  QImage::Format_RGBA8888)
        .copy();
}

void darkenNight(QImage& picture, const GeographicPoint& subsolar, const Ellipsoid& ellipsoid)
{
    const Vec3 to_sun = directionToSun(subsolar, ellipsoid);
    std::vector<double> along_equator; // of the direction to the sun, toward each column
    for (int column = 0; column < picture.width(); ++column) {
        const Angle longitude = placeOfPixel(static_cast<std::size_t>(column), 0).longitude;
        along_equator.push_back(std::cos(longitude.radians()) * to_sun.x +
                                std::sin(longitude.radians()) * to_sun.y);
    }
    for (int row = 0; row < picture.height(); ++row) {
        auto* pixel = reinterpret_cast<QRgb*>(picture.scanLine(row));
        const Angle latitude = placeOfPixel(0, static_cast<std::size_t>(row)).latitude;
        const Vec3 up = localAxes(ellipsoid, {.longitude = {}, .latitude = latitude}).up;
        for (const double toward : along_equator) {
            const double height = up.x * toward + up.z * to_sun.z;
            const double day = std::clamp(0.5 + 0.5 * height / kTwilight, 0.0, 1.0);
            const double share = kOverviewNight + (1.0 - kOverviewNight) * day;
            const auto lit = [share](int color) { return static_cast<int>(share * color); };
            *pixel =
                qRgba(lit(qRed(*pixel)), lit(qGreen(*pixel)), lit(qBlue(*pixel)), qAlpha(*pixel));
            ++pixel;
        }
    }
}

} // namespace marsview
