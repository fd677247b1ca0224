#include "ui/overlay/drawn_marks.h"

#include "ui/canvas/terrain_view.h"
#include "ui/drawing/drawing_base.h"
#include "ui/widgets/plate.h"

#include <QEvent>
#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

constexpr double kHandleRadius = 4.5;
constexpr double kHandleRim = 1.5;
constexpr double kHiddenOpacity = 0.35;
constexpr double kNeighborRadius = 7.0;      // of a point of a neighbor, as large as its symbol
constexpr QPointF kLabelOffset{10.0, -10.0}; // from its place to its nearest corner
constexpr double kLabelPadding = 4.0;

} // namespace

DrawnMarks::DrawnMarks(const DrawingBase& drawing, QWidget* view)
    : QWidget(view)
    , drawing_(&drawing)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setGeometry(view->rect());
    view->installEventFilter(this);
    connect(&drawing, &DrawingBase::moved, this, &DrawnMarks::noteMove);
    connect(&drawing, &DrawingBase::changed, this, &DrawnMarks::noteChange);
    if (const auto* terrain = qobject_cast<TerrainView*>(view)) {
        connect(terrain, &TerrainView::exaggerationChanged, this, &DrawnMarks::forget);
        connect(terrain, &TerrainView::layersChanged, this, &DrawnMarks::forget);
    }
}

void DrawnMarks::setObstacles(const QList<QWidget*>& obstacles)
{
    obstacles_ = obstacles;
    for (QWidget* obstacle : obstacles_) {
        obstacle->installEventFilter(this);
    }
}

void DrawnMarks::forget()
{
    marks_.reset();
}

void DrawnMarks::noteChange()
{
    forget();
    update();
    Q_EMIT marksChanged();
}

void DrawnMarks::showNew()
{
    const std::uint64_t revision = drawing_ ? drawing_->handlesRevision() : 0;
    if (std::exchange(shown_of_, revision) != revision) {
        showOnTerrain();
    }
}

// Who places something beside the marks has asked for them when the camera moved.
void DrawnMarks::noteMove()
{
    if (parentWidget()->isHidden()) {
        return; // the other scene is shown
    }
    showNew();
    const std::uint64_t revision = drawing_ ? drawing_->handlesRevision() : 0;
    if (painted_of_ != revision) {
        update();
    }
    if (!marks_ || marks_of_ != revision) {
        Q_EMIT marksChanged();
    }
}

// Labels of the neighbor change without a change here: its results arrive, or have other units.
void DrawnMarks::giveWayToNeighbor()
{
    gives_way_ = true;
    connect(neighbor_, &DrawnMarks::marksChanged, this, [this] {
        if (marks_ && !areMarksKnown()) {
            update();
            Q_EMIT marksChanged();
        }
    });
}

bool DrawnMarks::areMarksKnown() const
{
    const std::uint64_t revision = drawing_ ? drawing_->handlesRevision() : 0;
    return marks_ && marks_of_ == revision &&
           (!gives_way_ || !drawing_ || given_way_to_ == neighbor_->labelBoxes());
}

const std::vector<DrawnMarks::Mark>& DrawnMarks::knownMarks() const
{
    if (!areMarksKnown()) {
        given_way_to_ = gives_way_ && drawing_ ? neighbor_->labelBoxes() : std::vector<QRectF>();
        marks_ = drawing_ ? marks() : std::vector<Mark>();
        marks_of_ = drawing_ ? drawing_->handlesRevision() : 0;
    }
    return *marks_;
}

const std::vector<DrawnHandle>& DrawnMarks::handles() const
{
    static const std::vector<DrawnHandle> none;
    return drawing_ ? drawing_->handles() : none;
}

bool DrawnMarks::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == parent()) {
        if (event->type() == QEvent::Resize) {
            setGeometry(parentWidget()->rect());
            forget();
        } else if (event->type() == QEvent::Show) {
            showNew();
        }
    } else if (event->type() == QEvent::Show || event->type() == QEvent::Hide ||
               event->type() == QEvent::Move || event->type() == QEvent::Resize) {
        // Labels make way for it, or return.
        marks_.reset();
        update();
        Q_EMIT marksChanged();
    }
    return QWidget::eventFilter(watched, event);
}

void DrawnMarks::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) {
        marks_.reset();
        label_stamps_.clear();
    }
    QWidget::changeEvent(event);
}

QColor DrawnMarks::colorOf(const Rgb8& color)
{
    return {color.red, color.green, color.blue};
}

QRectF DrawnMarks::boxAround(QPointF place, double radius)
{
    return {place - QPointF(radius, radius), QSizeF(2.0 * radius, 2.0 * radius)};
}

DrawnMarks::Mark DrawnMarks::handleMark(const DrawnHandle& handle, bool is_current)
{
    const double radius = is_current ? kHandleRadius : kHandleRadius - 1.0;
    return {boxAround(handle.place, radius + kHandleRim), false,
            [handle, is_current, radius](QPainter& painter) {
                QPainterPath dot;
                dot.addEllipse(handle.place, radius, radius);
                painter.setOpacity(handle.is_hidden ? kHiddenOpacity : 1.0);
                painter.fillPath(dot, colorOf(is_current ? kCurrentDrawnColor : kDrawnColor));
                painter.setPen(QPen(QColor(0, 0, 0, 200), kHandleRim));
                painter.drawPath(dot);
                painter.setOpacity(1.0);
            }};
}

DrawnMarks::LabelRoom DrawnMarks::roomBeside(const std::vector<QRectF>& marks) const
{
    LabelRoom room{.labels = BoxGrid(rect()), .marks = BoxGrid(rect())};
    for (std::size_t i = 0; i < std::min(marks.size(), kMarksMax); ++i) {
        room.marks.add(marks[i]);
    }
    if (neighbor_ != nullptr) {
        if (gives_way_) {
            for (const QRectF& box : given_way_to_) {
                room.labels.add(box);
            }
        }
        const std::vector<DrawnHandle>& others = neighbor_->handles();
        for (std::size_t i = 0; i < std::min(others.size(), kMarksMax); ++i) {
            room.marks.add(boxAround(others[i].place, kNeighborRadius));
        }
    }
    return room;
}

std::optional<DrawnMarks::Mark>
DrawnMarks::labelMark(QPointF place, const QString& text, LabelRoom& room) const
{
    const QFontMetricsF metrics(font(), this); // as this screen draws it
    const QSizeF size(widthOf(text) + 2.0 * kLabelPadding, metrics.height() + kLabelPadding);
    const auto plate = labelBox(place, size, room);
    if (!plate) {
        return std::nullopt;
    }
    room.labels.add(*plate);
    return Mark{*plate, true, [this, plate = *plate, text](QPainter& painter) {
                    paintLabel(painter, plate, text);
                }};
}

double DrawnMarks::widthOf(const QString& text) const
{
    constexpr qsizetype kStampsMax = 1000;
    const auto known = label_stamps_.constFind(text);
    if (known != label_stamps_.constEnd()) {
        return known->width;
    }
    if (label_stamps_.size() >= kStampsMax) {
        label_stamps_.clear();
    }
    const double width = QFontMetricsF(font(), this).horizontalAdvance(text);
    label_stamps_.insert(text, {.width = width, .picture = {}});
    return width;
}

void DrawnMarks::paintLabel(QPainter& painter, const QRectF& plate, const QString& text) const
{
    const auto draw = [&text](QPainter& on, const QRectF& at) {
        drawPlate(on, at);
        // Fractions of a pixel that letters are wider at 150 % cut nothing off.
        const QRectF wide = at.adjusted(-kLabelPadding, 0.0, kLabelPadding, 0.0);
        drawText(on, wide, Qt::AlignCenter, text);
    };
    if (painter.device() != this) { // a picture of another size
        draw(painter, plate);
        return;
    }
    const double scale = devicePixelRatioF();
    if (scale != label_scale_) {
        label_stamps_.clear();
        label_scale_ = scale;
    }
    LabelStamp& stamp = label_stamps_[text];
    if (stamp.picture.isNull()) {
        stamp.width = plate.width() - 2.0 * kLabelPadding;
        stamp.picture = QPixmap((plate.size() * scale).toSize() + QSize(1, 1));
        stamp.picture.setDevicePixelRatio(scale);
        stamp.picture.fill(Qt::transparent);
        QPainter stamping(&stamp.picture);
        stamping.setRenderHint(QPainter::Antialiasing);
        stamping.setFont(painter.font());
        draw(stamping, QRectF(QPointF(), plate.size()));
    }
    // On whole pixels, so that it stays sharp.
    const QPointF corner = plate.topLeft() * scale;
    painter.drawPixmap(QPointF(std::round(corner.x()), std::round(corner.y())) / scale,
                       stamp.picture);
}

// Not all of them are children of the view.
QRectF DrawnMarks::placeOf(const QWidget& obstacle) const
{
    return obstacle.parentWidget() == parentWidget()
               ? QRectF(obstacle.geometry())
               : QRectF(mapFromGlobal(obstacle.mapToGlobal(QPointF())), QSizeF(obstacle.size()));
}

std::optional<QRectF>
DrawnMarks::labelBox(QPointF place, const QSizeF& size, const LabelRoom& room) const
{
    const double x = kLabelOffset.x();
    const double y = kLabelOffset.y();
    const std::array<QPointF, 4> corners{place + QPointF(x, y - size.height()),
                                         place + QPointF(-x - size.width(), y - size.height()),
                                         place + QPointF(x, -y),
                                         place + QPointF(-x - size.width(), -y)};
    const QRectF inside = QRectF(rect()).adjusted(2.0, 2.0, -2.0, -2.0);
    std::optional<QRectF> over_marks; // if there is nothing better
    for (const QPointF& corner : corners) {
        const QRectF box(corner, size);
        if (!inside.contains(box) || !room.labels.isClear(box)) {
            continue;
        }
        const bool is_clear = std::none_of(
            obstacles_.begin(), obstacles_.end(), [this, &box](const QWidget* obstacle) {
                return obstacle->isVisible() && box.intersects(placeOf(*obstacle));
            });
        if (!is_clear) {
            continue;
        }
        if (room.marks.isClear(box)) {
            return box;
        }
        over_marks = over_marks.value_or(box);
    }
    return over_marks;
}

std::vector<QRectF> DrawnMarks::labelBoxes() const
{
    std::vector<QRectF> boxes;
    for (const Mark& mark : knownMarks()) {
        if (mark.is_label) {
            boxes.push_back(mark.box);
        }
    }
    return boxes;
}

std::vector<QRectF> DrawnMarks::takenBoxes() const
{
    constexpr std::size_t kHandlesMax = 200; // between more, no name has room
    std::vector<QRectF> boxes = labelBoxes();
    if (handles().size() <= kHandlesMax) {
        for (const DrawnHandle& handle : handles()) {
            boxes.push_back(boxAround(handle.place, kNeighborRadius));
        }
    }
    if (drawing_) {
        const std::vector<QRectF> lines = drawing_->lineBoxes();
        boxes.insert(boxes.end(), lines.begin(), lines.end());
    }
    return boxes;
}

void DrawnMarks::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    for (const Mark& mark : knownMarks()) {
        mark.draw(painter);
    }
    painted_of_ = marks_of_;
}

std::vector<PicturePart> DrawnMarks::partsFor(const QSize& picture) const
{
    // The field of view is vertical, and the camera looks at the middle of both pictures.
    const double scale = static_cast<double>(picture.height()) / height();
    const QPointF corner(0.5 * (width() - picture.width() / scale), 0.0);
    std::vector<PicturePart> parts;
    const auto add = [&](const Mark& mark) {
        const QRectF box = mark.box.adjusted(-1.0, -1.0, 1.0, 1.0);
        QImage image((box.size() * scale).toSize(), QImage::Format_ARGB32_Premultiplied);
        image.fill(Qt::transparent);
        QPainter painter(&image);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setFont(font());
        painter.scale(scale, scale);
        painter.translate(-box.topLeft());
        mark.draw(painter);
        painter.end();
        parts.push_back(
            {.image = std::move(image), .at = ((box.topLeft() - corner) * scale).toPoint()});
    };
    for (const Mark& mark : marksOnTerrain()) {
        add(mark);
    }
    for (const Mark& mark : knownMarks()) {
        add(mark);
    }
    return parts;
}

} // namespace marsview
