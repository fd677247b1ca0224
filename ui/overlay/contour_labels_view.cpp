#include "ui/overlay/contour_labels_view.h"

#include <QEvent>
#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

constexpr double kLetterRim = 3.0; // points around letters, half of it visible
const QColor kLetters(20, 18, 15);
const QColor kLetterHalo(255, 255, 255, 205);

} // namespace

ContourLabelsView::ContourLabelsView(QWidget& view, ContourView contours)
    : QWidget(&view)
    , contours_(std::move(contours))
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Elevations of contour lines"));
    setGeometry(view.rect());
    view.installEventFilter(this);
}

void ContourLabelsView::clear()
{
    found_.clear();
    follow();
}

void ContourLabelsView::setHeightUnit(HeightUnit unit)
{
    if (unit != unit_) {
        unit_ = unit;
        find();
    }
}

void ContourLabelsView::setObstacles(std::function<std::vector<QRectF>()> obstacles)
{
    obstacles_ = std::move(obstacles);
}

QString ContourLabelsView::textOf(double elevation_m) const
{
    const double rest = std::abs(elevation_m - std::round(elevation_m));
    const QString number =
        rest < 1e-6 ? numberText(elevation_m, 0) : shortNumberText(elevation_m, 6);
    return leftToRight(
        unit_ == HeightUnit::Meters ? number : withUnit(number, unitSymbol(HeightUnit::Meters)));
}

double ContourLabelsView::widthOf(double elevation_m) const
{
    return QFontMetricsF(font()).horizontalAdvance(textOf(elevation_m)) + 2.0 * kLetterRim;
}

double ContourLabelsView::lineHeight() const
{
    return QFontMetricsF(font()).height();
}

void ContourLabelsView::find()
{
    found_.clear();
    if (isVisible()) {
        const double scale = devicePixelRatioF();
        std::vector<LabelBox> boxes;
        for (const QRectF& box : obstacles_ ? obstacles_() : std::vector<QRectF>{}) {
            boxes.push_back(
                {box.left() * scale, box.top() * scale, box.right() * scale, box.bottom() * scale});
        }
        found_ = contours_.labels({.viewport = contours_.viewport(),
                                   .pixels_per_point = scale,
                                   .exaggeration = contours_.exaggeration(),
                                   .obstacles = boxes},
                                  lineHeight() * scale, [this, scale](double elevation_m) {
                                      return widthOf(elevation_m) * scale;
                                  });
        shown_ = found_;
        update();
        return;
    }
    follow();
}

void ContourLabelsView::follow()
{
    const bool had_any = !shown_.empty();
    shown_.clear();
    for (const ContourLabel& label : found_) {
        if (const auto here = contours_.follow(label)) {
            shown_.push_back(*here);
        }
    }
    if (had_any || !shown_.empty()) {
        update();
    }
}

// `scale`: pixels of the label's picture in a point of the painter.
void ContourLabelsView::draw(QPainter& painter, const ContourLabel& label, double scale) const
{
    const QString text = textOf(label.elevation_m);
    const QFontMetricsF metrics(font());
    QPainterPath path;
    path.addText(-0.5 * metrics.horizontalAdvance(text),
                 0.5 * (metrics.ascent() - metrics.descent()), font(), text);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(label.middle.x / scale, label.middle.y / scale);
    painter.rotate(label.angle_rad * 180.0 / std::numbers::pi);
    painter.strokePath(path,
                       QPen(kLetterHalo, kLetterRim, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.fillPath(path, kLetters);
    painter.restore();
}

void ContourLabelsView::paintEvent(QPaintEvent* /*event*/)
{
    if (shown_.empty()) {
        return;
    }
    QPainter painter(this);
    for (const ContourLabel& label : shown_) {
        draw(painter, label, devicePixelRatioF());
    }
}

bool ContourLabelsView::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == parent() && event->type() == QEvent::Resize) {
        setGeometry(parentWidget()->rect());
    }
    return QWidget::eventFilter(watched, event);
}

std::vector<PicturePart> ContourLabelsView::partsFor(const decltype(ContourView::labels)& labels_of,
                                                     const QSize& size,
                                                     const std::vector<QRect>& obstacles) const
{
    std::vector<PicturePart> parts;
    const double scale = static_cast<double>(size.height()) / height();
    std::vector<LabelBox> boxes;
    for (const QRect& box : obstacles) {
        boxes.push_back({static_cast<double>(box.left()), static_cast<double>(box.top()),
                         static_cast<double>(box.left() + box.width()),
                         static_cast<double>(box.top() + box.height())});
    }
    const auto labels = labels_of({.viewport = {.width = size.width(), .height = size.height()},
                                   .pixels_per_point = scale,
                                   .exaggeration = contours_.exaggeration(),
                                   .obstacles = boxes},
                                  lineHeight() * scale, [this, scale](double elevation_m) {
                                      return widthOf(elevation_m) * scale;
                                  });
    for (const ContourLabel& label : labels) {
        const QPoint corner(static_cast<int>(std::floor(label.box.left)),
                            static_cast<int>(std::floor(label.box.top)));
        QImage image(QSize(static_cast<int>(std::ceil(label.box.right)) - corner.x() + 1,
                           static_cast<int>(std::ceil(label.box.bottom)) - corner.y() + 1),
                     QImage::Format_ARGB32_Premultiplied);
        image.fill(Qt::transparent);
        QPainter painter(&image);
        painter.translate(-corner);
        painter.scale(scale, scale);
        draw(painter, label, scale);
        painter.end();
        parts.push_back({.image = std::move(image), .at = corner});
    }
    return parts;
}

} // namespace marsview
