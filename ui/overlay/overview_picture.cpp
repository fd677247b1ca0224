#include "ui/overlay/overview_picture.h"

#include "core/base/check.h"
#include "core/view/map_preview.h"

#include <QPainter>
#include <QTransform>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// Twice the width of the overview map on a screen with two pixels a point.
constexpr std::size_t kPictureSideMax = 640;

struct LayerPicture {
    QImage image;
    SceneFrame frame; // of its pixels
};

LayerPicture pictureOf(const ShownLayer& layer,
                       const SceneFrame& layer_frame,
                       const TerrainLook& look,
                       double exaggeration)
{
    const BlockMeans& means = layer.map->analysis()->means;
    std::size_t level = 0;
    while (std::max(means.means(level).columns(), means.means(level).rows()) > kPictureSideMax) {
        ++level;
    }
    const GridView<const float> heights = means.means(level);
    const Georeference& georeference = layer.map->georeference();
    const SceneFrame frame = previewFrame(layer_frame, georeference.columns(), georeference.rows(),
                                          heights.columns(), heights.rows());
    const MapPreview preview = mapPreview(heights, frame,
                                          {.ramp = sampledRamp(*layer.ramp),
                                           .tint_range = colorRangeOf(layer),
                                           .light_azimuth = look.light_azimuth,
                                           .light_altitude = look.light_altitude,
                                           .exaggeration = exaggeration});
    return {.image = QImage(preview.rgba.data(), static_cast<int>(preview.columns),
                            static_cast<int>(preview.rows), static_cast<int>(4 * preview.columns),
                            QImage::Format_RGBA8888)
                         .copy(),
            .frame = frame};
}

// Pixels of an image, counted from its corner, to those of another in the same scene.
QTransform fromTo(const SceneFrame& from, const SceneFrame& to)
{
    const auto moved = [&](double x, double y) {
        const GridPoint grid = to.toGrid(from.toScene({x - 0.5, y - 0.5}, 0.0));
        return QPointF(grid.column + 0.5, grid.row + 0.5);
    };
    const QPointF corner = moved(0.0, 0.0);
    const QPointF right = moved(1.0, 0.0) - corner;
    const QPointF down = moved(0.0, 1.0) - corner;
    return {right.x(), right.y(), down.x(), down.y(), corner.x(), corner.y()};
}

} // namespace

OverviewPicture overviewPicture(const std::vector<ShownLayer>& layers,
                                const SceneSurface& ground,
                                const TerrainLook& look,
                                double exaggeration)
{
    MARSVIEW_CHECK(!layers.empty() && layers.size() == ground.maps().size());
    if (layers.size() == 1) {
        const Georeference& georeference = layers.front().map->georeference();
        const SceneFrame& frame = ground.maps().front().frame;
        return {.image = pictureOf(layers.front(), frame, look, exaggeration).image,
                .frame = frame,
                .columns = georeference.columns(),
                .rows = georeference.rows()};
    }
    const SceneBox box = ground.box(1.0);
    const double width_m = box.maximum.x - box.minimum.x;
    const double height_m = box.maximum.y - box.minimum.y;
    const double pixel_m = std::max(width_m, height_m) / static_cast<double>(kPictureSideMax);
    const auto side = [pixel_m](double meters) {
        return std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(meters / pixel_m)));
    };
    OverviewPicture overview{
        .image = {},
        .frame = {.origin = {-box.minimum.x / pixel_m - 0.5, box.maximum.y / pixel_m - 0.5},
                  .east_per_column = pixel_m,
                  .north_per_row = -pixel_m},
        .columns = side(width_m),
        .rows = side(height_m)};
    overview.image = QImage(static_cast<int>(overview.columns), static_cast<int>(overview.rows),
                            QImage::Format_ARGB32_Premultiplied);
    overview.image.fill(Qt::transparent);
    QPainter painter(&overview.image);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    for (std::size_t i = layers.size(); i > 0; --i) {
        const LayerPicture picture =
            pictureOf(layers[i - 1], ground.maps()[i - 1].frame, look, exaggeration);
        painter.setTransform(fromTo(picture.frame, overview.frame));
        painter.drawImage(QPointF(0.0, 0.0), picture.image);
    }
    return overview;
}

} // namespace marsview
