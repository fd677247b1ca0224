#include "ui/overlay/minimap.h"

#include "ui/widgets/plate.h"

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

QColor footprintColor()
{
    return {255, 255, 255};
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

ScenePoint Minimap::onMap(const ScenePoint& place) const
{
    GridPoint grid = map_->frame.toGrid(place);
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
                  camera_ ? camera_->target.z : 0.0});
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
    if (event->button() == Qt::LeftButton) {
        is_dragged_ = false;
    }
}

void Minimap::keyPressEvent(QKeyEvent* event)
{
    if (!map_ || !camera_ || !isArrow(event->key())) {
        QWidget::keyPressEvent(event);
        return;
    }
    const bool is_fine = (event->modifiers() & Qt::ShiftModifier) != 0;
    const double step_m = std::max(bounds_.east - bounds_.west, bounds_.north - bounds_.south) *
                          (is_fine ? kKeyStepFine : kKeyStep);
    ScenePoint target = camera_->target;
    target.x += event->key() == Qt::Key_Right ? step_m : event->key() == Qt::Key_Left ? -step_m : 0;
    target.y += event->key() == Qt::Key_Up ? step_m : event->key() == Qt::Key_Down ? -step_m : 0;
    Q_EMIT placeRequested(onMap(target));
}

void Minimap::describe()
{
    QString text = tr("No map");
    if (map_ && !camera_) {
        text = tr("The whole map");
    } else if (map_) {
        const auto percent = [](double share) {
            return QLocale().toString(static_cast<int>(std::lround(share * 100.0)));
        };
        const double east = (camera_->target.x - bounds_.west) / (bounds_.east - bounds_.west);
        const double north = (camera_->target.y - bounds_.south) / (bounds_.north - bounds_.south);
        //: For screen readers: %1 and %2 are percentages of the map's width and height, %3 of its
        //: area
        text = tr("The view is at %1% of the way from west to east and %2% from south to north; "
                  "%3% of the map is in sight. Arrow keys move it.")
                   .arg(percent(east), percent(north), percent(shareOfMap(footprint_, *map_)));
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
        map_painter.setRenderHint(QPainter::SmoothPixmapTransform);
        map_painter.setRenderHint(QPainter::Antialiasing);
        if (!preview_.isNull()) {
            map_painter.setTransform(from_grid_);
            map_painter.drawImage(QRectF(-0.5, -0.5, static_cast<double>(map_->columns),
                                         static_cast<double>(map_->rows)),
                                  preview_);
            map_painter.resetTransform();
        }
        QPolygonF outline;
        for (const GridPoint& corner : outerCorners(*map_)) {
            outline << from_grid_.map(QPointF(corner.column, corner.row));
        }
        map_painter.setPen(QPen(overlayFaintColor(), 1.0));
        map_painter.setBrush(Qt::NoBrush);
        map_painter.drawPolygon(outline);
    }
    painter.drawPixmap(0, 0, drawn_map_);
    if (camera_) {
        painter.setClipRect(QRectF(rect()).adjusted(2.0, 2.0, -2.0, -2.0));
        drawCamera(painter);
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
    QPolygonF sight{eye, end(wedge.left)};
    // An arc, as the corners of a wide wedge would cut off its front.
    const double from = std::atan2(wedge.left.x, wedge.left.y);
    double sweep = std::atan2(wedge.right.x, wedge.right.y) - from;
    sweep = sweep < 0.0 ? sweep + 2.0 * std::numbers::pi : sweep;
    constexpr int kArcSteps = 16;
    for (int i = 1; i < kArcSteps; ++i) {
        const double heading = from + sweep * i / kArcSteps;
        sight << end({std::sin(heading), std::cos(heading), 0.0});
    }
    sight << end(wedge.right);
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

} // namespace marsview
