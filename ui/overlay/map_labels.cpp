#include "ui/overlay/map_labels.h"

#include "core/view/label_placement.h"
#include "ui/canvas/terrain_view.h"
#include "ui/overlay/drawn_marks.h"

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {

MapLabels::MapLabels(TerrainView& view)
    : LabelsOverlay(view)
    , view_(view)
{
    setAccessibleName(tr("Names and graticule"));
    connect(&view, &TerrainView::layersChanged, this, &MapLabels::showScene);
    connect(&view, &TerrainView::mapShown, this, &MapLabels::showScene);
    connect(&view, &TerrainView::exaggerationChanged, this, &MapLabels::showSight);
    connect(&view, &TerrainView::sightChanged, this, &MapLabels::showSight);
    // Finer tiles may have arrived.
    connect(&view, &TerrainView::pictureCompleted, this, &MapLabels::showSight);
}

void MapLabels::setNames(std::shared_ptr<const Gazetteer> names)
{
    if (names != gazetteer_) {
        gazetteer_ = std::move(names);
        names_.reset();
        maps_.clear();
        forgetPictures();
        showScene();
        Q_EMIT namesChanged();
    }
}

void MapLabels::setNamesShown(bool is_shown)
{
    are_names_shown_ = is_shown;
    showScene();
}

void MapLabels::setGraticuleShown(bool is_shown)
{
    is_graticule_shown_ = is_shown;
    showSight();
}

void MapLabels::setCoordinateFormat(const CoordinateFormat& format)
{
    format_ = format;
    showSight();
    Q_EMIT formatChanged();
}

void MapLabels::keepClearOf(const DrawnMarks& marks)
{
    marked_.push_back(&marks);
    connect(&marks, &DrawnMarks::marksChanged, this, [this] {
        if (markedBoxes() != marked_boxes_) {
            showSightSoon();
        }
    });
}

std::vector<QRectF> MapLabels::markedBoxes() const
{
    std::vector<QRectF> boxes;
    for (const DrawnMarks* marks : marked_) {
        const std::vector<QRectF> more = marks->takenBoxes();
        boxes.insert(boxes.end(), more.begin(), more.end());
    }
    return boxes;
}

void MapLabels::setCursorPlace(const std::optional<QPointF>& place)
{
    const auto covered = [this] {
        std::vector<bool> on_cursor(marks_.size());
        std::transform(marks_.begin(), marks_.end(), on_cursor.begin(),
                       [this](const Mark& mark) { return isOnCursor(mark); });
        return on_cursor;
    };
    const std::vector<bool> before = covered();
    cursor_ = place;
    if (covered() != before) {
        update();
    }
}

bool MapLabels::isOnCursor(const Mark& mark) const
{
    return cursor_ && mark.label.box.intersects(aroundCursor(*cursor_));
}

// Names stay where they are unless the maps change.
void MapLabels::showScene()
{
    const auto& maps = view_.ground().maps();
    const bool is_same =
        maps.size() == maps_.size() &&
        std::equal(maps.begin(), maps.end(), maps_.begin(),
                   [](const SceneMap& map, const auto& known) { return map.map == known.lock(); });
    if (!gazetteer_ || !are_names_shown_ || maps.empty()) {
        names_.reset();
        maps_.clear();
    } else if (!names_ || !is_same) {
        names_ = std::make_unique<NameLabels>(gazetteer_, view_.ground());
        maps_.assign(maps.size(), {});
        std::transform(maps.begin(), maps.end(), maps_.begin(),
                       [](const SceneMap& map) { return map.map; });
    }
    showSight();
}

void MapLabels::showSight()
{
    const bool had_marks = !marks_.empty();
    marks_.clear();
    names_shown_.clear();
    values_shown_.clear();
    drawGraticule();
    if (view_.map()) {
        const Sight sight{.camera = view_.camera(),
                          .viewport = view_.viewport(),
                          .scale = view_.devicePixelRatioF()};
        std::vector<LabelBox> taken = obstacleBoxes(sight.scale);
        marked_boxes_ = markedBoxes();
        for (const QRectF& box : marked_boxes_) {
            taken.push_back(scaled(box, sight.scale));
        }
        marks_ = marksOf(sight, names_.get(), std::move(taken));
        for (const Mark& mark : marks_) {
            (mark.is_name ? names_shown_ : values_shown_).push_back(mark.label);
        }
    }
    if (had_marks || !marks_.empty()) {
        update();
    }
}

void MapLabels::drawGraticule()
{
    const bool was_drawn = !graticule_.lines.empty();
    // Where the projection makes lines slow, those of a moment ago do while the camera moves.
    if (was_drawn && is_graticule_shown_ && view_.isMoving() && pace_.isTooSoon()) {
        return;
    }
    pace_.begin();
    graticule_ = {};
    if (is_graticule_shown_ && view_.map()) {
        graticule_ = graticuleOf(view_.ground(), view_.camera(),
                                 {.viewport = view_.viewport(),
                                  .pixels_per_point = view_.devicePixelRatioF(),
                                  .exaggeration = view_.exaggeration(),
                                  .notation = format_.angles,
                                  .latitudes = format_.latitudesOn(view_.map()->info().body)});
    }
    if (!was_drawn && graticule_.lines.empty()) {
        return;
    }
    view_.setLines(graticuleLines(graticule_.lines), LineSet::Graticule);
    pace_.end();
}

std::vector<PicturePart> MapLabels::partsFor(const OrbitCamera& camera,
                                             const QSize& size,
                                             const std::vector<QRect>& obstacles)
{
    if (!view_.map() || !isVisible()) {
        return {};
    }
    const Sight sight{.camera = camera,
                      .viewport = {.width = size.width(), .height = size.height()},
                      .scale = static_cast<double>(size.height()) / height()};
    // Measurements and annotations are drawn as in the view.
    std::vector<LabelBox> taken =
        takenIn(size, obstacles, camera == view_.camera() ? markedBoxes() : std::vector<QRectF>{});
    // Of their own, because those of the view remember what they showed last.
    std::unique_ptr<NameLabels> names;
    if (names_) {
        names = std::make_unique<NameLabels>(gazetteer_, view_.ground());
    }
    std::vector<PlacedName> labels;
    for (const Mark& mark : marksOf(sight, names.get(), std::move(taken))) {
        labels.push_back({.text = mark.label.text,
                          .box = mark.label.box,
                          .size = mark.size,
                          .point = mark.point});
    }
    return partsOf(labels, sight.scale);
}

std::vector<MapLabels::Mark>
MapLabels::marksOf(const Sight& sight, NameLabels* names, std::vector<LabelBox> taken)
{
    std::vector<Mark> marks;
    placeValues(sight, taken, marks);
    if (names) {
        placeNames(sight, *names, taken, marks);
    }
    return marks;
}

// At the lower and the left edge, or where lines end.
void MapLabels::placeValues(const Sight& sight,
                            std::vector<LabelBox>& taken,
                            std::vector<Mark>& marks)
{
    std::vector<GraticuleLabel> labels;
    for (const GraticuleLine& line : graticule_.lines) {
        if (const auto end = labelEnd(line, sight.camera, sight.viewport)) {
            labels.push_back(
                {.axis = line.axis, .value = line.value, .place = end->place, .pixel = end->pixel});
        }
    }
    const auto is_visible = [&](const ScenePoint& place) {
        return marsview::isVisible(view_.ground(), sight.camera, sight.viewport,
                                   view_.exaggeration(), place);
    };
    for (PlacedName& value : valuesIn(labels,
                                      {.longitude_step = graticule_.longitude_step,
                                      .latitude_step = graticule_.latitude_step,
                                      .coordinates = format_,
                                      .body = view_.map()->info().body},
                                      sight.viewport, sight.scale, is_visible, taken)) {
        marks.push_back({.label = {.text = std::move(value.text), .box = value.box},
                         .is_name = false,
                         .size = value.size,
                         .point = {}});
    }
}

void MapLabels::placeNames(const Sight& sight,
                           NameLabels& names,
                           const std::vector<LabelBox>& taken,
                           std::vector<Mark>& marks)
{
    for (PlacedName& name : namesIn(sight.camera,
                                    {.viewport = sight.viewport,
                                    .pixels_per_point = sight.scale,
                                    .exaggeration = view_.exaggeration(),
                                    .obstacles = taken},
                                    names)) {
        marks.push_back({.label = {.text = std::move(name.text), .box = name.box},
                         .is_name = true,
                         .size = name.size,
                         .point = name.point});
    }
}

void MapLabels::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    for (const Mark& mark : marks_) {
        if (isOnCursor(mark)) {
            continue;
        }
        if (mark.point) {
            drawLabelDot(painter, *mark.point);
        }
        painter.drawPixmap(mark.label.box.topLeft().toPoint(), picture(mark.label.text, mark.size));
    }
}

} // namespace marsview
