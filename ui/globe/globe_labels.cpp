#include "ui/globe/globe_labels.h"

#include "core/globe/body_camera.h"
#include "core/globe/body_view.h"
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
    setAccessibleName(tr("Names and graticule"));
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

void GlobeLabels::setGraticuleShown(bool is_shown)
{
    if (is_shown != is_graticule_shown_) {
        is_graticule_shown_ = is_shown;
        showSight();
    }
}

void GlobeLabels::setCoordinateFormat(const CoordinateFormat& format)
{
    format_ = format;
    showSight();
}

void GlobeLabels::setTaken(std::vector<QRectF> boxes)
{
    if (boxes != taken_) {
        taken_ = std::move(boxes);
        showSightSoon();
    }
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
    const bool had_labels = !labels_.empty() || !values_.empty();
    labels_.clear();
    values_.clear();
    drawGraticule();
    if (!globe_.scene().isEmpty() && !globe_.isHidden()) {
        const Sight now = sight();
        std::vector<LabelBox> taken = obstacleBoxes(now.scale);
        for (const QRectF& box : taken_) {
            taken.push_back(scaled(box, now.scale));
        }
        values_ = valuesOf(graticule_, now, taken);
        if (names_) {
            labels_ = namesOf(now, taken, *names_);
        }
    }
    if (had_labels || !labels_.empty() || !values_.empty()) {
        update();
    }
}

GlobeLabels::Sight GlobeLabels::sight() const
{
    return {.camera = globe_.camera(),
            .viewport = globe_.viewport(),
            .scale = globe_.devicePixelRatioF()};
}

std::vector<GlobeLabels::Label> GlobeLabels::valuesOf(const BodyGraticule& graticule,
                                                      const Sight& sight,
                                                      std::vector<LabelBox>& taken) const
{
    const CameraPose pose = poseOf(sight.camera, globe_.scene().ellipsoid());
    return valuesIn(
        graticule.labels,
        {.longitude_step = graticule.longitude_step,
         .latitude_step = graticule.latitude_step,
         .coordinates = format_,
         .body = globe_.terrain()->map()->info().body},
        sight.viewport, sight.scale,
        [&](const ScenePoint& place) {
            return marsview::isVisible(globe_.scene(), pose, sight.viewport, globe_.exaggeration(),
                                       place, sight.scale);
        },
        taken);
}

std::vector<GlobeLabels::Label> GlobeLabels::namesOf(const Sight& sight,
                                                     const std::vector<LabelBox>& taken,
                                                     NameLabels& names) const
{
    return namesIn(poseOf(sight.camera, globe_.scene().ellipsoid()),
                   {.viewport = sight.viewport,
                    .pixels_per_point = sight.scale,
                    .exaggeration = globe_.exaggeration(),
                    .obstacles = taken},
                   names);
}

std::vector<PicturePart> GlobeLabels::partsFor(const BodyCamera& camera,
                                               const QSize& size,
                                               const std::vector<QRect>& obstacles)
{
    if (globe_.scene().isEmpty() || !isVisible()) {
        return {};
    }
    const Sight sight{.camera = camera,
                      .viewport = {.width = size.width(), .height = size.height()},
                      .scale = static_cast<double>(size.height()) / height()};
    // Measurements and annotations are drawn as in the window.
    std::vector<LabelBox> taken =
        takenIn(size, obstacles, camera == globe_.camera() ? taken_ : std::vector<QRectF>{});
    std::vector<Label> labels = valuesOf(graticuleIn(sight), sight, taken);
    if (names_) {
        // Of their own, because those of the window remember what they showed last.
        NameLabels names(gazetteer_, globe_.scene());
        const std::vector<Label> more = namesOf(sight, taken, names);
        labels.insert(labels.end(), more.begin(), more.end());
    }
    return partsOf(labels, sight.scale);
}

void GlobeLabels::drawGraticule()
{
    const bool was_drawn = !graticule_.lines.empty();
    // Where the terrain makes lines slow, those of a moment ago do while the camera moves.
    if (was_drawn && is_graticule_shown_ && globe_.isMoving() && pace_.isTooSoon()) {
        return;
    }
    pace_.begin();
    graticule_ = globe_.isHidden() ? BodyGraticule{} : graticuleIn(sight());
    if (!was_drawn && graticule_.lines.empty()) {
        return;
    }
    globe_.setLines(graticuleLines(graticule_.lines), LineSet::Graticule);
    pace_.end();
}

BodyGraticule GlobeLabels::graticuleIn(const Sight& sight) const
{
    const BodyScene& scene = globe_.scene();
    if (!is_graticule_shown_ || scene.isEmpty()) {
        return {};
    }
    const HeightRange range = scene.range();
    const double exaggeration = globe_.exaggeration();
    const BodyView view(
        poseOf(sight.camera, scene.ellipsoid()), sight.viewport, scene.ellipsoid(),
        {.lowest_m = range.minimum_m, .highest_m = range.maximum_m, .exaggeration = exaggeration});
    return bodyGraticule(
        sight.camera, view,
        [&](const GeographicPoint& place) { return scene.height(place) * exaggeration; },
        {.pixels_per_point = sight.scale,
         .notation = format_.angles,
         .latitudes = format_.latitudesOn(globe_.terrain()->map()->info().body)});
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
    paintLabels(values_, cursor, painter);
    paintLabels(labels_, cursor, painter);
}

void GlobeLabels::paintLabels(const std::vector<Label>& labels,
                              const QRectF& cursor,
                              QPainter& painter)
{
    for (const Label& label : labels) {
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
