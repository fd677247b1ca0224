#include "ui/overlay/minimap.h"

#include "ui/widgets/plate.h"

#include <QFontMetricsF>
#include <QKeyEvent>
#include <QLocale>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QRadialGradient>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

constexpr int kRim = 5;            // between the plate's edge and the map
constexpr QSize kSmallest(80, 50); // below, it shows nothing that helps
constexpr int kThinnest = 24;      // of the plate, for maps that are long strips

constexpr double kKeyStep = 1.0 / 20.0; // of the map's longer side
constexpr double kKeyStepFine = 1.0 / 100.0;

constexpr double kWedgeShortest = 20.0;
constexpr double kWedgeLongest = 48.0;     // shows the direction, not the sight: the footprint does
constexpr double kFootprintSmallest = 7.0; // below, a ring shows where it is
constexpr double kOutlineSmallest = 4.0;
constexpr int kLabelPixels = 9;
constexpr double kLabeledSmallest = 110.0; // the disc, to have labels in it
constexpr int kArcSteps = 16;
constexpr double kTurn = 360.0; // degrees

QColor footprintColor()
{
    return {255, 255, 255};
}

QColor outlineColor()
{
    return {150, 205, 255};
}

QColor cameraColor()
{
    return {255, 209, 92};
}

bool isArrow(int key)
{
    return key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Up || key == Qt::Key_Down;
}

// Corners of the raster's pixels.
std::array<GridPoint, 4> outerCorners(const MapPlan& map)
{
    const double right = static_cast<double>(map.columns) - 0.5;
    const double bottom = static_cast<double>(map.rows) - 0.5;
    return {GridPoint{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}};
}

} // namespace

Minimap::Minimap(QWidget* parent)
    : QWidget(parent)
{
    setFocusPolicy(Qt::TabFocus); // a click leaves the focus with the map
    setCursor(Qt::CrossCursor);
    setAccessibleName(tr("Overview map"));
    setToolTip(tr("Click or drag to look at another place"));
    describe();
}

void Minimap::setMap(const QImage& preview,
                     const SceneFrame& frame,
                     std::size_t columns,
                     std::size_t rows)
{
    preview_ = preview.convertToFormat(QImage::Format_ARGB32_Premultiplied);
    map_ = MapPlan{.frame = frame, .columns = columns, .rows = rows};
    bounds_ = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
    for (const GridPoint& corner : outerCorners(*map_)) {
        const ScenePoint p = frame.toScene(corner, 0.0);
        bounds_.west = std::min(bounds_.west, p.x);
        bounds_.east = std::max(bounds_.east, p.x);
        bounds_.south = std::min(bounds_.south, p.y);
        bounds_.north = std::max(bounds_.north, p.y);
    }
    camera_.reset();
    sight_.reset();
    disc_.reset();
    outlines_.clear();
    footprint_.clear();
    is_dragged_ = false;
    place();
    describe();
    updateGeometry();
    Q_EMIT roomChanged();
    update();
}

void Minimap::clear()
{
    if (map_) {
        map_.reset();
        preview_ = {};
        camera_.reset();
        sight_.reset();
        disc_.reset();
        outlines_.clear();
        footprint_.clear();
        is_dragged_ = false;
        drawn_map_ = {};
        describe();
        Q_EMIT roomChanged();
        update();
    }
}

void Minimap::setCamera(const OrbitCamera& camera, const Viewport& viewport)
{
    if (!map_ || (camera_ == camera && viewport.width == viewport_.width &&
                  viewport.height == viewport_.height)) {
        return;
    }
    camera_ = camera;
    viewport_ = viewport;
    footprint_ = footprint(camera, viewport, *map_);
    describe();
    update();
}

void Minimap::setOutlines(std::vector<QPolygonF> outlines)
{
    outlines_ = std::move(outlines);
    drawn_map_ = {};
    update();
}

void Minimap::setDisc(const MinimapDisc& disc)
{
    disc_ = disc;
    drawn_map_ = {};
    describe();
    update();
}

void Minimap::setSight(const MinimapSight& sight)
{
    if (map_) {
        sight_ = sight;
        describe();
        update();
    }
}

std::optional<ScenePoint> Minimap::target() const
{
    return sight_    ? std::optional(sight_->target)
           : camera_ ? std::optional(camera_->target)
                     : std::nullopt;
}

void Minimap::setLargestSize(QSize size)
{
    if (size != largest_size_) {
        largest_size_ = size;
        updateGeometry();
    }
}

QSize Minimap::sizeHint() const
{
    if (!map_ || largest_size_.width() < kSmallest.width() ||
        largest_size_.height() < kSmallest.height()) {
        return {0, 0};
    }
    const double east = bounds_.east - bounds_.west;
    const double north = bounds_.north - bounds_.south;
    const double scale = std::min((largest_size_.width() - 2 * kRim) / east,
                                  (largest_size_.height() - 2 * kRim) / north);
    const auto side = [scale](double meters) {
        return std::max(kThinnest, static_cast<int>(std::lround(meters * scale)) + 2 * kRim);
    };
    return {std::min(side(east), largest_size_.width()),
            std::min(side(north), largest_size_.height())};
}

void Minimap::place()
{
    drawn_map_ = {};
    if (!map_) {
        return;
    }
    pixels_per_meter_ =
        std::min(std::max(1, width() - 2 * kRim) / (bounds_.east - bounds_.west),
                 std::max(1, height() - 2 * kRim) / (bounds_.north - bounds_.south));
    middle_ = QPointF(width() / 2.0, height() / 2.0);
    const SceneFrame& frame = map_->frame;
    const QPointF origin = positionOf(frame.toScene({0.0, 0.0}, 0.0));
    from_grid_ = QTransform(frame.east_per_column * pixels_per_meter_,
                            -frame.north_per_column * pixels_per_meter_,
                            frame.east_per_row * pixels_per_meter_,
                            -frame.north_per_row * pixels_per_meter_, origin.x(), origin.y());
}

QPointF Minimap::positionOf(const ScenePoint& place) const
{
    const double middle_x = (bounds_.west + bounds_.east) / 2.0;
    const double middle_y = (bounds_.south + bounds_.north) / 2.0;
    return middle_ + QPointF(place.x - middle_x, middle_y - place.y) * pixels_per_meter_;
}

// Longitude goes on behind the edge of a map of a whole body.
ScenePoint Minimap::onMap(const ScenePoint& place) const
{
    if (disc_) {
        const double radius = (bounds_.east - bounds_.west) / 2.0;
        const double share = std::min(1.0, radius / std::hypot(place.x, place.y));
        return {place.x * share, place.y * share, place.z};
    }
    const double x = sight_ ? std::remainder(place.x, kTurn) : place.x;
    GridPoint grid = map_->frame.toGrid({x, place.y, place.z});
    grid.column = std::clamp(grid.column, 0.0, static_cast<double>(map_->columns - 1));
    grid.row = std::clamp(grid.row, 0.0, static_cast<double>(map_->rows - 1));
    return map_->frame.toScene(grid, place.z);
}

ScenePoint Minimap::placeAt(QPointF position) const
{
    if (!map_) {
        return {};
    }
    const QPointF off = (position - middle_) / pixels_per_meter_;
    return onMap({(bounds_.west + bounds_.east) / 2.0 + off.x(),
                  (bounds_.south + bounds_.north) / 2.0 - off.y(),
                  target().value_or(ScenePoint{}).z});
}

void Minimap::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    place();
}

bool Minimap::event(QEvent* event)
{
    // The window's arrow keys pan; while this has the focus they are its own.
    if (event->type() == QEvent::ShortcutOverride && map_ &&
        isArrow(static_cast<QKeyEvent*>(event)->key())) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void Minimap::mousePressEvent(QMouseEvent* event)
{
    // Other buttons are accepted, too: they would do something to the map behind.
    event->accept();
    if (event->button() == Qt::LeftButton && map_) {
        is_dragged_ = true;
        Q_EMIT placeRequested(placeAt(event->position()));
    }
}

void Minimap::mouseMoveEvent(QMouseEvent* event)
{
    event->accept();
    if (is_dragged_ && map_) {
        Q_EMIT placeRequested(placeAt(event->position()));
    }
}

void Minimap::mouseReleaseEvent(QMouseEvent* event)
{
    event->accept();
    if (event->button() == Qt::LeftButton && is_dragged_) {
        is_dragged_ = false;
        Q_EMIT dragEnded();
    }
}

void Minimap::keyPressEvent(QKeyEvent* event)
{
    if (!map_ || !target() || !isArrow(event->key())) {
        QWidget::keyPressEvent(event);
        return;
    }
    const bool is_fine = (event->modifiers() & Qt::ShiftModifier) != 0;
    const double step_m = std::max(bounds_.east - bounds_.west, bounds_.north - bounds_.south) *
                          (is_fine ? kKeyStepFine : kKeyStep);
    ScenePoint to = *target();
    to.x += event->key() == Qt::Key_Right ? step_m : event->key() == Qt::Key_Left ? -step_m : 0;
    to.y += event->key() == Qt::Key_Up ? step_m : event->key() == Qt::Key_Down ? -step_m : 0;
    Q_EMIT placeRequested(onMap(to));
}

void Minimap::describe()
{
    QString text = tr("No map");
    if (map_ && !target()) {
        text = tr("The whole map");
    } else if (map_) {
        const auto percent = [](double share) {
            return QLocale().toString(static_cast<int>(std::lround(share * 100.0)));
        };
        const ScenePoint at = *target();
        const double seen = sight_ ? sight_->share : shareOfMap(footprint_, *map_);
        const double east = (at.x - bounds_.west) / (bounds_.east - bounds_.west);
        const double north = (at.y - bounds_.south) / (bounds_.north - bounds_.south);
        //: For screen readers: %1 and %2 are percentages of the map's width and height, %3 of its
        //: area
        text = tr("The view is at %1% of the way from west to east and %2% from south to north; "
                  "%3% of the map is in sight. Arrow keys move it.")
                   .arg(percent(east), percent(north), percent(seen));
        if (disc_ && sight_) {
            //: For screen readers: %1 is what the map shows, "North pole", %2 a position, %3 a
            //: percentage of the map's area
            text = tr("%1. The view is at %2; %3% of the map is in sight. Arrow keys move it.")
                       .arg(disc_->name, sight_->place, percent(seen));
        }
    }
    if (text != accessibleDescription()) {
        setAccessibleDescription(text);
    }
}

void Minimap::paintEvent(QPaintEvent* /*event*/)
{
    if (!map_) {
        return;
    }
    QPainter painter(this);
    drawPlate(painter, rect());
    const double ratio = devicePixelRatioF();
    if (drawn_map_.isNull() || drawn_map_.devicePixelRatio() != ratio) {
        drawn_map_ = QPixmap(size() * ratio);
        drawn_map_.setDevicePixelRatio(ratio);
        drawn_map_.fill(Qt::transparent);
        QPainter map_painter(&drawn_map_);
        drawMap(map_painter);
    }
    painter.drawPixmap(0, 0, drawn_map_);
    if (target()) {
        painter.setClipRect(QRectF(rect()).adjusted(2.0, 2.0, -2.0, -2.0));
        sight_ ? drawSight(painter) : drawCamera(painter);
        painter.setClipping(false);
    }
    if (hasFocus()) {
        drawFocus(painter, rect());
    }
}

void Minimap::drawCamera(QPainter& painter) const
{
    painter.setRenderHint(QPainter::Antialiasing);
    const CameraWedge wedge = cameraWedge(*camera_, viewport_, map_->frame);
    const QPointF eye = from_grid_.map(QPointF(wedge.eye.column, wedge.eye.row));

    if (!footprint_.empty()) {
        QPolygonF outline;
        for (const GridPoint& p : footprint_) {
            outline << from_grid_.map(QPointF(p.column, p.row));
        }
        QPainterPath path;
        if (std::max(outline.boundingRect().width(), outline.boundingRect().height()) <
            kFootprintSmallest) {
            path.addEllipse(positionOf(camera_->target), kFootprintSmallest / 2.0,
                            kFootprintSmallest / 2.0);
        } else {
            path.addPolygon(outline);
            path.closeSubpath();
        }
        painter.fillPath(path, QColor(255, 255, 255, 40));
        drawContrasting(painter, path, footprintColor(), 1.3);
    }

    const double reach =
        std::clamp(wedge.length_m * pixels_per_meter_, kWedgeShortest, kWedgeLongest);
    const auto end = [&](const Vec3& direction) {
        return eye + QPointF(direction.x, -direction.y) * reach;
    };
    std::vector<QPointF> arc{end(wedge.left)};
    // An arc, as the corners of a wide wedge would cut off its front.
    const double from = std::atan2(wedge.left.x, wedge.left.y);
    double sweep = std::atan2(wedge.right.x, wedge.right.y) - from;
    sweep = sweep < 0.0 ? sweep + 2.0 * std::numbers::pi : sweep;
    for (int i = 1; i < kArcSteps; ++i) {
        const double heading = from + sweep * i / kArcSteps;
        arc.push_back(end({std::sin(heading), std::cos(heading), 0.0}));
    }
    arc.push_back(end(wedge.right));
    drawWedge(painter, eye, arc);
}

// On a map of a whole body, where shapes are wider toward the poles.
void Minimap::drawSight(QPainter& painter) const
{
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const QRectF map(positionOf({bounds_.west, bounds_.north, 0.0}),
                     positionOf({bounds_.east, bounds_.south, 0.0}));
    if (disc_) {
        painter.setClipPath(edge(), Qt::IntersectClip);
    }
    painter.drawImage(map, sight_->seen);
    QPainterPath path;
    for (const QLineF& edge : sight_->edges) {
        path.moveTo(positionOf({edge.x1(), edge.y1(), 0.0}));
        path.lineTo(positionOf({edge.x2(), edge.y2(), 0.0}));
    }
    const QRectF extent = path.boundingRect();
    if (std::max(extent.width(), extent.height()) < kFootprintSmallest) {
        path = {};
        path.addEllipse(positionOf(sight_->target), kFootprintSmallest / 2.0,
                        kFootprintSmallest / 2.0);
        painter.fillPath(path, QColor(255, 255, 255, 40));
    }
    drawContrasting(painter, path, footprintColor(), 1.3);

    const QPointF eye = positionOf(sight_->eye);
    std::vector<QPointF> arc;
    for (int i = 0; i <= kArcSteps && !sight_->is_from_above; ++i) {
        const double heading =
            sight_->heading.radians() +
            sight_->half_width.radians() * (2.0 * static_cast<double>(i) / kArcSteps - 1.0);
        arc.push_back(eye + QPointF(std::sin(heading), -std::cos(heading)) * kWedgeShortest);
    }
    drawWedge(painter, eye, arc);
}

// From the eye over an arc, which may be empty.
void Minimap::drawWedge(QPainter& painter, QPointF eye, const std::vector<QPointF>& arc) const
{
    QPolygonF sight{eye};
    double reach = 1.0;
    for (const QPointF& end : arc) {
        sight << end;
        reach = std::hypot(end.x() - eye.x(), end.y() - eye.y());
    }
    QColor color = cameraColor();
    QRadialGradient fade(eye, reach);
    color.setAlpha(170);
    fade.setColorAt(0.0, color);
    color.setAlpha(0);
    fade.setColorAt(1.0, color);
    painter.setPen(Qt::NoPen);
    painter.setBrush(fade);
    painter.drawPolygon(sight);
    painter.setBrush(QColor(0, 0, 0, 190));
    painter.drawEllipse(eye, 4.5, 4.5);
    painter.setBrush(cameraColor());
    painter.drawEllipse(eye, 3.2, 3.2);
}

// Around the pixels of the raster, or the disc.
QPainterPath Minimap::edge() const
{
    QPainterPath path;
    if (disc_) {
        path.addEllipse(QRectF(positionOf({bounds_.west, bounds_.north, 0.0}),
                               positionOf({bounds_.east, bounds_.south, 0.0})));
        return path;
    }
    QPolygonF corners;
    for (const GridPoint& corner : outerCorners(*map_)) {
        corners << from_grid_.map(QPointF(corner.column, corner.row));
    }
    path.addPolygon(corners);
    path.closeSubpath();
    return path;
}

// What does not change with the camera.
void Minimap::drawMap(QPainter& painter) const
{
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.setRenderHint(QPainter::Antialiasing);
    if (disc_) {
        painter.setClipPath(edge());
    }
    if (!preview_.isNull()) {
        painter.setTransform(from_grid_);
        painter.drawImage(
            QRectF(-0.5, -0.5, static_cast<double>(map_->columns), static_cast<double>(map_->rows)),
            preview_);
        painter.resetTransform();
    }
    drawLines(painter);
    painter.setClipping(false);
    painter.setPen(QPen(overlayFaintColor(), 1.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(edge());
    drawLabels(painter);
}

void Minimap::drawLines(QPainter& painter) const
{
    const auto line_of = [this](const QPolygonF& points) {
        QPolygonF line;
        for (const QPointF& point : points) {
            line << positionOf({point.x(), point.y(), 0.0});
        }
        return line;
    };
    if (disc_) {
        painter.setPen(QPen(QColor(255, 255, 255, 70), 1.0));
        for (const QPolygonF& line : disc_->lines) {
            painter.drawPolyline(line_of(line));
        }
    }
    for (const QPolygonF& outline : outlines_) {
        QPainterPath path;
        path.addPolygon(line_of(outline));
        const QRectF extent = path.boundingRect();
        if (std::max(extent.width(), extent.height()) < kOutlineSmallest) {
            path = {};
            path.addRect(QRectF(extent.center() - QPointF(kOutlineSmallest, kOutlineSmallest) / 2.0,
                                QSizeF(kOutlineSmallest, kOutlineSmallest)));
        }
        drawContrasting(painter, path, outlineColor(), 1.0);
    }
}

// Of the graticule, within the disc, and the caption in its corner.
void Minimap::drawLabels(QPainter& painter) const
{
    if (!disc_) {
        return;
    }
    QFont small = font();
    small.setPixelSize(kLabelPixels);
    const QFontMetricsF metrics(small);
    const QRectF inside = edge().boundingRect();
    const auto draw = [&](const QRectF& box, const QString& text, int alpha) {
        QPainterPath path;
        path.addText(box.left(), box.top() + metrics.ascent(), small, text);
        painter.strokePath(path, QPen(QColor(0, 0, 0, 150), 2.0));
        QColor color = overlayTextColor();
        color.setAlpha(alpha);
        painter.fillPath(path, color);
    };
    double top = inside.top() - 1.0;
    for (const QString& line : disc_->caption.split(QLatin1Char('\n'))) {
        draw({inside.left(), top, metrics.horizontalAdvance(line), metrics.height()}, line, 255);
        top += metrics.height() - 1.0;
    }
    if (inside.width() < kLabeledSmallest) {
        return;
    }
    for (const MinimapDisc::Label& label : disc_->labels) {
        QRectF box(0.0, 0.0, metrics.horizontalAdvance(label.text), metrics.height());
        box.moveCenter(positionOf({label.at.x(), label.at.y(), 0.0}));
        // Those at the edge are moved into it.
        box.moveLeft(
            std::clamp(box.left(), inside.left() + 3.0, inside.right() - 3.0 - box.width()));
        box.moveTop(
            std::clamp(box.top(), inside.top() + 1.0, inside.bottom() - 1.0 - box.height()));
        draw(box, label.text, 190);
    }
}

} // namespace marsview
