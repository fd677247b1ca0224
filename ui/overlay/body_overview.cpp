#include "ui/overlay/body_overview.h"

#include "core/geo/body_layout.h"
#include "core/globe/body_camera.h"
#include "core/globe/sunlight.h"
#include "core/view/map_preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace marsview {
namespace {

constexpr double kDegreesPerPixel = 360.0 / static_cast<double>(kOverviewColumns);
constexpr double kPlanePerPixel = 2.0 / static_cast<double>(kPolarOverviewSide);
constexpr int kOutlineSteps = 64; // a side of a raster

// Of the colors of the day: places in the night are still to be recognized.
constexpr double kOverviewNight = 0.35;
constexpr double kTwilight = 0.1; // sine of the sun's altitude on either side of the terminator
constexpr int kReadsMax = 3;      // a pixel of the overview around a pole, along a side

GeographicPoint placeOfPixel(std::size_t column, std::size_t row)
{
    return {.longitude =
                Angle::degrees(-180.0 + (static_cast<double>(column) + 0.5) * kDegreesPerPixel),
            .latitude = Angle::degrees(90.0 - (static_cast<double>(row) + 0.5) * kDegreesPerPixel)};
}

GeographicPoint placeOfPixel(BodyOverview overview, std::size_t column, std::size_t row)
{
    return overview == BodyOverview::Whole
               ? placeOfPixel(column, row)
               : PolarPlane(overview).placeAt(
                     {(static_cast<double>(column) + 0.5) * kPlanePerPixel - 1.0,
                      1.0 - (static_cast<double>(row) + 0.5) * kPlanePerPixel});
}

// The level whose blocks are about as large as a pixel.
std::size_t levelFor(const BodyTerrain& terrain, double pixel_m)
{
    const BlockMeans& means = terrain.map()->analysis()->means;
    double block_m = terrain.map()->georeference().pixelHeightMeters() *
                     static_cast<double>(means.blockSamples());
    std::size_t level = 0;
    while (block_m < 0.7 * pixel_m && level + 1 < means.levelCount()) {
        block_m *= 2.0;
        ++level;
    }
    return level;
}

// The means of a level by the position on the map's grid.
class BlockReader {
public:
    BlockReader(const BlockMeans& means, std::size_t level)
        : heights_m_(means.means(level))
        , block_(static_cast<double>(means.blockSamples()) * std::exp2(level))
    {}

    float at(const GridPoint& grid) const
    {
        const auto index = [this](double place, std::size_t count) {
            return std::min(static_cast<std::size_t>(std::max(0.0, place / block_)), count - 1);
        };
        return heights_m_(index(grid.column, heights_m_.columns()),
                          index(grid.row, heights_m_.rows()));
    }

private:
    GridView<const float> heights_m_;
    double block_;
};

// Around a pole the columns of a map are close together: places within a pixel are read apart.
// Where blocks are larger than pixels, the samples are read.
std::vector<float> polarHeights(const BodyTerrain& terrain, JobMonitor& monitor, PolarPlane plane)
{
    const BlockMeans& means = terrain.map()->analysis()->means;
    const double pixel_m =
        kPlanePerPixel * PolarPlane::unitAtPole() * terrain.grid()->ellipsoid().equatorial_m;
    const double sample_m = terrain.map()->georeference().pixelHeightMeters();
    const bool are_samples = !terrain.map()->heightfield().isTiled() &&
                             sample_m * static_cast<double>(means.blockSamples()) > pixel_m;
    const BlockReader blocks(means, levelFor(terrain, pixel_m));
    const int reads =
        are_samples ? std::clamp(static_cast<int>(std::ceil(pixel_m / sample_m)), 1, kReadsMax)
                    : kReadsMax;
    std::vector<float> result;
    result.reserve(kPolarOverviewSide * kPolarOverviewSide);
    for (std::size_t row = 0; row < kPolarOverviewSide; ++row) {
        if (monitor.isCanceled()) {
            return {};
        }
        for (std::size_t column = 0; column < kPolarOverviewSide; ++column) {
            double sum_m = 0.0;
            int count = 0;
            for (int i = 0; i < reads * reads; ++i) {
                const auto within = [reads](int number) { return (number + 0.5) / reads; };
                const auto grid = terrain.gridAt(plane.placeAt(
                    {(static_cast<double>(column) + within(i % reads)) * kPlanePerPixel - 1.0,
                     1.0 - (static_cast<double>(row) + within(i / reads)) * kPlanePerPixel}));
                const double height_m = !grid         ? std::numeric_limits<double>::quiet_NaN()
                                        : are_samples ? terrain.heightOnGrid(*grid)
                                                      : static_cast<double>(blocks.at(*grid));
                if (std::isfinite(height_m)) {
                    sum_m += height_m;
                    ++count;
                }
            }
            result.push_back(2 * count < reads * reads ? std::numeric_limits<float>::quiet_NaN()
                                                       : static_cast<float>(sum_m / count));
        }
    }
    return result;
}

// Lines along the edges of a map, in pieces. Not across a seam, nor, if `are_poles_left_out`, along
// rows next to a pole that the map closes at.
template <typename F>
void eachEdgePlace(const Georeference& georeference, bool are_poles_left_out, F&& take)
{
    const double right = static_cast<double>(georeference.columns() - 1);
    const double bottom = static_cast<double>(georeference.rows() - 1);
    const std::array<GridPoint, 5> corners{GridPoint{0.0, 0.0}, GridPoint{right, 0.0},
                                           GridPoint{right, bottom}, GridPoint{0.0, bottom},
                                           GridPoint{0.0, 0.0}};
    const auto layout = are_poles_left_out && hasMeridiansAsColumns(georeference)
                            ? bodyLayout(georeference)
                            : Result<BodyLayout>(BodyLayout{});
    const bool is_first_left_out =
        layout && (layout->closes_first || (layout->wraps && layout->first_row > 0));
    const bool is_last_left_out =
        layout && (layout->closes_last || (layout->wraps && layout->has_row_after));
    for (std::size_t side = 0; side + 1 < corners.size(); ++side) {
        if ((georeference.wrapsAround() && side % 2 == 1) || (side == 0 && is_first_left_out) ||
            (side == 2 && is_last_left_out)) {
            take(std::nullopt);
            continue;
        }
        for (int i = 0; i <= kOutlineSteps; ++i) {
            const double share = static_cast<double>(i) / kOutlineSteps;
            const GridPoint& from = corners[side];
            const GridPoint& to = corners[side + 1];
            take(georeference.toGeographic({from.column + share * (to.column - from.column),
                                            from.row + share * (to.row - from.row)}));
        }
    }
}

} // namespace

std::vector<float>
overviewHeights(const BodyTerrain& terrain, JobMonitor& monitor, BodyOverview overview)
{
    if (overview != BodyOverview::Whole) {
        return polarHeights(terrain, monitor, PolarPlane(overview));
    }
    // On the equator.
    const double pixel_m =
        kDegreesPerPixel / 180.0 * std::numbers::pi * terrain.grid()->ellipsoid().equatorial_m;
    const BlockReader blocks(terrain.map()->analysis()->means, levelFor(terrain, pixel_m));
    std::vector<float> result;
    result.reserve(kOverviewColumns * kOverviewRows);
    for (std::size_t row = 0; row < kOverviewRows; ++row) {
        if (monitor.isCanceled()) {
            return {};
        }
        for (std::size_t column = 0; column < kOverviewColumns; ++column) {
            const auto grid = terrain.gridAt(placeOfPixel(column, row));
            result.push_back(grid ? blocks.at(*grid) : std::numeric_limits<float>::quiet_NaN());
        }
    }
    return result;
}

std::vector<QPolygonF> outlineOf(const Georeference& georeference, BodyOverview overview)
{
    std::vector<QPolygonF> pieces(1);
    const bool is_whole = overview == BodyOverview::Whole;
    eachEdgePlace(georeference, !is_whole, [&](const std::optional<GeographicPoint>& place) {
        if (!place) {
            pieces.emplace_back();
            return;
        }
        if (!is_whole) {
            const PolarPlane plane(overview);
            if (place->latitude.radians() * (plane.isNorth() ? 1.0 : -1.0) < 0.0) {
                pieces.emplace_back();
                return;
            }
            const PolarPoint point = plane.at(*place);
            pieces.back() << QPointF(point.x, point.y);
            return;
        }
        const QPointF point(std::remainder(place->longitude.degrees(), 360.0),
                            place->latitude.degrees());
        if (!pieces.back().isEmpty() && std::abs(point.x() - pieces.back().last().x()) > 180.0) {
            pieces.emplace_back();
        }
        pieces.back() << point;
    });
    std::erase_if(pieces, [](const QPolygonF& piece) { return piece.size() < 2; });
    return pieces;
}

QSize overviewSize(BodyOverview overview)
{
    constexpr auto kSide = static_cast<int>(kPolarOverviewSide);
    return overview == BodyOverview::Whole
               ? QSize(static_cast<int>(kOverviewColumns), static_cast<int>(kOverviewRows))
               : QSize(kSide, kSide);
}

SceneFrame overviewFrame(BodyOverview overview)
{
    if (overview != BodyOverview::Whole) {
        return {.origin = {1.0 / kPlanePerPixel - 0.5, 1.0 / kPlanePerPixel - 0.5},
                .east_per_column = kPlanePerPixel,
                .north_per_row = -kPlanePerPixel};
    }
    return {.origin = {180.0 / kDegreesPerPixel - 0.5, 90.0 / kDegreesPerPixel - 0.5},
            .east_per_column = kDegreesPerPixel,
            .north_per_row = -kDegreesPerPixel};
}

QImage overviewOf(const std::vector<float>& heights_m,
                  BodyOverview overview,
                  const ShownLayer& layer,
                  const TerrainLook& look,
                  double exaggeration,
                  double equatorial_m)
{
    const QSize size = overviewSize(overview);
    const auto columns = static_cast<std::size_t>(size.width());
    const auto rows = static_cast<std::size_t>(size.height());
    if (heights_m.size() != columns * rows) {
        return {};
    }
    SceneFrame frame = overviewFrame(overview);
    const double unit_m =
        equatorial_m *
        (overview == BodyOverview::Whole ? std::numbers::pi / 180.0 : PolarPlane::unitAtPole());
    frame.east_per_column *= unit_m;
    frame.north_per_row *= unit_m;
    const MapPreview preview =
        mapPreview(GridView<const float>(heights_m.data(), columns, rows), frame,
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

void darkenNight(QImage& picture,
                 BodyOverview overview,
                 const GeographicPoint& subsolar,
                 const Ellipsoid& ellipsoid)
{
    const Vec3 to_sun = directionToSun(subsolar, ellipsoid);
    for (int row = 0; row < picture.height(); ++row) {
        auto* pixel = reinterpret_cast<QRgb*>(picture.scanLine(row));
        for (int column = 0; column < picture.width(); ++column, ++pixel) {
            const GeographicPoint place = placeOfPixel(overview, static_cast<std::size_t>(column),
                                                       static_cast<std::size_t>(row));
            const double height = dot(localAxes(ellipsoid, place).up, to_sun);
            const double day = std::clamp(0.5 + 0.5 * height / kTwilight, 0.0, 1.0);
            const double share = kOverviewNight + (1.0 - kOverviewNight) * day;
            const auto lit = [share](int color) { return static_cast<int>(share * color); };
            *pixel =
                qRgba(lit(qRed(*pixel)), lit(qGreen(*pixel)), lit(qBlue(*pixel)), qAlpha(*pixel));
        }
    }
}

} // namespace marsview
