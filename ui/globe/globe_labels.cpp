#include "ui/globe/globe_labels.h"

#include "core/globe/body_camera.h"
#include "ui/globe/globe_view.h"

#include <QPainter>

#include <algorithm>
#include <utility>

namespace marsview {
GlobeLabels::GlobeLabels(GlobeView& globe)
    : LabelsOverlay(globe)
    , globe_(globe)
{
    setObjectName(QStringLiteral("globeLabels"));
    setAccessibleName(tr("Names"));
    connect(&globe, &GlobeView::placed, this, &GlobeLabels::showScene);
    connect(&globe, &GlobeView::sceneChanged, this, &GlobeLabels::showScene);
    connect(&globe, &GlobeView::sightChanged, this, &GlobeLabels::showSight);
    // Finer tiles may have arrived.
    connect(&globe, &GlobeView::pictureCompleted, this, &GlobeLabels::showSight);
    connect(&globe, &GlobeView::stylusMoved, this, qOverload<>(&QWidget::update));
}

void GlobeLabels::setNames(std::shared_ptr<const Gazetteer> names)
{
    if (names != gazetteer_) {
        gazetteer_ = std::move(names);
        names_.reset();
        maps_.clear();
        forgetPictures();
        showScene();
    }
}

void GlobeLabels::setNamesShown(bool is_shown)
{
    are_names_shown_ = is_shown;
    showScene();
}

// Looks do not move names: only other maps do.
void GlobeLabels::showScene()
{
    const std::vector<BodyTerrain>& maps = globe_.scene().maps();
    const bool is_same = std::equal(
        maps.begin(), maps.end(), maps_.begin(), maps_.end(),
        [](const BodyTerrain& map, const auto& known) { return map.map() == known.lock(); });
    if (!gazetteer_ || !are_names_shown_ || maps.empty() ||
        gazetteer_->body() != maps.front().map()->info().body) {
        names_.reset();
        maps_.clear();
    } else if (!names_ || !is_same) {
        names_ = std::make_unique<NameLabels>(gazetteer_, globe_.scene());
        maps_.clear();
        for (const BodyTerrain& map : maps) {
            maps_.emplace_back(map.map());
        }
    }
    showSight();
}

void GlobeLabels::showSight()
{
    const bool had_labels = !labels_.empty();
    labels_.clear();
    if (names_ && !globe_.scene().isEmpty() && !globe_.isHidden()) {
        const double scale = globe_.devicePixelRatioF();
        const std::vector<LabelBox> taken = obstacleBoxes(scale);
        labels_ = namesIn(poseOf(globe_.camera(), globe_.scene().ellipsoid()),
                          {.viewport = globe_.viewport(),
                           .pixels_per_point = scale,
                           .exaggeration = globe_.exaggeration(),
                           .obstacles = taken},
                          *names_);
    }
    if (had_labels || !labels_.empty()) {
        update();
    }
}

// Empty without a stylus.
QRectF GlobeLabels::aroundStylus() const
{
    const auto& stylus = globe_.stylus();
    if (!stylus || globe_.scene().isEmpty()) {
        return {};
    }
    const auto pixel = project(poseOf(globe_.camera(), globe_.scene().ellipsoid()),
                               globe_.viewport(), stylus->proxy);
    if (!pixel) {
        return {};
    }
    return aroundCursor(QPointF(pixel->x, pixel->y) / globe_.devicePixelRatioF());
}

void GlobeLabels::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    const QRectF cursor = aroundStylus();
    for (const Label& label : labels_) {
        if (label.box.intersects(cursor)) {
            continue;
        }
        if (label.point) {
            drawLabelDot(painter, *label.point);
        }
        painter.drawPixmap(label.box.topLeft().toPoint(), picture(label.text, label.size));
    }
}

} // namespace marsview
