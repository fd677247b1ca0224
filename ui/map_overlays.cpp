#include "ui/map_overlays.h"

#include "core/view/edge_mark.h"
#include "core/view/map_preview.h"
#include "core/view/scale_bar.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/force_meter.h"
#include "ui/overlay/gesture_hint.h"
#include "ui/overlay/hand_pointer.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/minimap.h"
#include "ui/overlay/overlay_layout.h"
#include "ui/overlay/scale_bar_view.h"
#include "ui/terrain_view.h"

#include <QAction>
#include <QApplication>
#include <QImage>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// Twice what the minimap is wide on a screen with two pixels a point.
constexpr std::size_t kPreviewSideMax = 640;

QImage
previewOf(const LoadedMap& map, const ColorRamp& ramp, const TerrainLook& look, double exaggeration)
{
    const BlockMeans& means = map.analysis->means;
    std::size_t level = 0;
    while (std::max(means.means(level).columns(), means.means(level).rows()) > kPreviewSideMax) {
        ++level;
    }
    const GridView<const float> heights = means.means(level);
    const Georeference& georeference = map.dataset->georeference();
    const SceneFrame frame = previewFrame(georeference.sceneFrame(), georeference.columns(),
                                          georeference.rows(), heights.columns(), heights.rows());
    const MapPreview preview = mapPreview(heights, frame,
                                          {.ramp = sampledRamp(ramp),
                                           .tint_range = tintedRange(ramp, map.tint_range),
                                           .light_azimuth = look.light_azimuth,
                                           .light_altitude = look.light_altitude,
                                           .exaggeration = exaggeration});
    return QImage(preview.rgba.data(), static_cast<int>(preview.columns),
                  static_cast<int>(preview.rows), static_cast<int>(4 * preview.columns),
                  QImage::Format_RGBA8888)
        .copy();
}

} // namespace

MapOverlays::MapOverlays(TerrainView& view)
    : QObject(&view)
    , view_(view)
    , minimap_(new Minimap(&view))
    , compass_(new Compass(&view))
    , scale_bar_(new ScaleBarView(&view))
    , legend_(new Legend(&view))
    , force_meter_(new ForceMeter(&view))
    , hand_pointer_(new HandPointer(&view))
    , hint_(new GestureHint(&view))
    , layout_(new OverlayLayout(&view,
                                {.minimap = minimap_,
                                 .legend = legend_,
                                 .compass = compass_,
                                 .scale_bar = scale_bar_,
                                 .force_meter = force_meter_,
                                 .hint = hint_}))
{
    makeAction(tr("&Overview Map"), QStringLiteral("minimap"), {minimap_});
    makeAction(tr("&Legend"), QStringLiteral("legend"), {legend_});
    makeAction(tr("&Compass and Scale Bar"), QStringLiteral("compass"), {compass_, scale_bar_});
    for (QWidget* part : std::initializer_list<QWidget*>{minimap_, compass_, scale_bar_, legend_}) {
        part->setCursor(Qt::ArrowCursor); // not the tool's
    }
    connect(&view_, &TerrainView::layersChanged, this, &MapOverlays::showMap);
    connect(&view_, &TerrainView::lookChanged, this, &MapOverlays::showMap);
    connect(&view_, &TerrainView::exaggerationChanged, this, &MapOverlays::showMap);
    connect(&view_, &TerrainView::sightChanged, this, &MapOverlays::showSight);
    connect(&view_, &TerrainView::stylusMoved, this, &MapOverlays::showTouch);
    connect(minimap_, &Minimap::placeRequested, &view_, &TerrainView::lookAt);
    connect(&view_, &TerrainView::gestureMade, hint_, &GestureHint::markDone);
    connect(hint_, &GestureHint::dismissed, this, &MapOverlays::dismissHint);
    layout_->setWanted(hint_, false);
    connect(compass_, &Compass::northRequested, &view_, &TerrainView::turnNorthUp);
    showMap();
}

void MapOverlays::offerHint()
{
    is_hint_offered_ = true;
    showMap();
}

void MapOverlays::dismissHint()
{
    if (is_hint_offered_) {
        is_hint_offered_ = false;
        if (hint_->isAncestorOf(QApplication::focusWidget())) {
            view_.setFocus();
        }
        layout_->setWanted(hint_, false);
        Q_EMIT hintDismissed();
    }
}

void MapOverlays::makeAction(const QString& text, const QString& name, const QList<QWidget*>& parts)
{
    auto* action = new QAction(text, this);
    action->setObjectName(name);
    action->setCheckable(true);
    action->setChecked(true);
    connect(action, &QAction::toggled, this, [this, parts](bool is_wanted) {
        for (QWidget* part : parts) {
            layout_->setWanted(part, is_wanted);
        }
    });
    actions_.append(action);
}

void MapOverlays::paintOver(QImage& picture) const
{
    picture.setDevicePixelRatio(view_.devicePixelRatioF());
    QPainter painter(&picture);
    for (QWidget* part : std::initializer_list<QWidget*>{legend_, compass_, scale_bar_}) {
        if (part->isVisible()) {
            part->render(&painter, part->pos(), QRegion(), QWidget::DrawChildren);
        }
    }
}

void MapOverlays::setCovered(int height)
{
    covered_height_ = height;
    layout_->setCovered(height);
    showHand();
}

void MapOverlays::showMap()
{
    layout_->setWanted(compass_, bool(view_.map()) && actions_.back()->isChecked());
    layout_->setWanted(hint_, bool(view_.map()) && is_hint_offered_);
    if (!view_.map()) {
        minimap_->clear();
        scale_bar_->clear();
        legend_->setContent({});
        return;
    }
    const Georeference& georeference = view_.map().dataset->georeference();
    minimap_->setMap(previewOf(view_.map(), *view_.ramp(), view_.look(), view_.exaggeration()),
                     georeference.sceneFrame(), georeference.columns(), georeference.rows());
    showSight();
}

void MapOverlays::showSight()
{
    showHand();
    if (!view_.map()) {
        return;
    }
    minimap_->setCamera(view_.camera(), view_.viewport());
    compass_->setCamera(view_.camera());
    scale_bar_->setCamera(view_.camera(), view_.viewport());
    showLegend();
}

void MapOverlays::showLegend()
{
    const LoadedMap& map = view_.map();
    const TerrainLook& look = view_.look();
    legend_->setContent({.mode = look.mode,
                         .ramp = view_.ramp(),
                         .range = tintedRange(*view_.ramp(), map.tint_range),
                         .contour_interval_m = contourInterval(
                             look, map.dataset->heightfield().range().value_or(HeightRange{}),
                             metresPerPixel(view_.camera(), view_.viewport()))});
}

void MapOverlays::showTouch()
{
    showHand();
    const auto& stylus = view_.shownStylus();
    if (!stylus || !stylus->is_in_contact) {
        force_meter_->release();
        return;
    }
    // As the hand has it: to the right and away along the heading of the view.
    const double azimuth = view_.camera().azimuth.radians();
    const Vec3 right{std::cos(azimuth), -std::sin(azimuth), 0.0};
    const Vec3 away{std::sin(azimuth), std::cos(azimuth), 0.0};
    const Vec3& force_n = stylus->force_n;
    force_meter_->setForce({dot(force_n, right), dot(force_n, away), force_n.z},
                           stylus->force_n_max);
}

// An arrow to the cursor, where that cannot be seen.
void MapOverlays::showHand()
{
    const auto& stylus = view_.shownStylus();
    const double scale = view_.devicePixelRatioF();
    const auto mark = stylus ? edgeMark(view_.camera(), stylus->proxy,
                                        {.viewport = view_.viewport(),
                                         .inset_px = HandPointer::kInset * scale,
                                         .covered_px = covered_height_ * scale})
                             : std::nullopt;
    if (mark) {
        hand_pointer_->pointTo(QPointF(mark->at.x, mark->at.y) / scale, {mark->right, mark->down});
    } else {
        hand_pointer_->release();
    }
}

} // namespace marsview
