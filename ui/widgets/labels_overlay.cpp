#include "ui/widgets/labels_overlay.h"

#include "ui/text/coordinate_text.h"

#include <QEvent>
#include <QPainter>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr double kLargeShare = 0.25;  // of the picture's height, across what has a large label
constexpr double kCursorReach = 22.0; // points around the cursor that it needs
constexpr qsizetype kPicturesMax = 600;
constexpr double kEdge = 4.0; // points between the edge of the picture and a value
constexpr std::size_t kValuesMax = 60;

} // namespace

LabelsOverlay::LabelsOverlay(QWidget& picture)
    : QWidget(&picture)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setGeometry(picture.rect());
    picture.installEventFilter(this);
    soon_.setSingleShot(true);
    soon_.setInterval(0);
    connect(&soon_, &QTimer::timeout, this, [this] { showSight(); });
}

void LabelsOverlay::setObstacles(std::vector<QWidget*> obstacles)
{
    obstacles_ = std::move(obstacles);
    for (QWidget* obstacle : obstacles_) {
        obstacle->installEventFilter(this);
    }
}

std::vector<LabelBox> LabelsOverlay::obstacleBoxes(double scale) const
{
    std::vector<LabelBox> boxes;
    for (const QWidget* obstacle : obstacles_) {
        if (obstacle->isVisible()) {
            boxes.push_back(scaled(obstacle->geometry(), scale));
        }
    }
    return boxes;
}

std::vector<PicturePart> LabelsOverlay::partsOf(const std::vector<PlacedName>& labels,
                                                double scale) const
{
    std::vector<PicturePart> parts;
    for (const PlacedName& label : labels) {
        if (label.point) {
            const QPointF margin(kLabelDotRadius + kLabelRim, kLabelDotRadius + kLabelRim);
            QImage dot((QSizeF(2.0 * margin.x(), 2.0 * margin.y()) * scale).toSize(),
                       QImage::Format_ARGB32_Premultiplied);
            dot.fill(Qt::transparent);
            QPainter painter(&dot);
            painter.scale(scale, scale);
            drawLabelDot(painter, margin);
            painter.end();
            parts.push_back(
                {.image = std::move(dot), .at = ((*label.point - margin) * scale).toPoint()});
        }
        parts.push_back({.image = labelPicture(label.text, labelFont(font(), label.size), scale),
                         .at = (label.box.topLeft() * scale).toPoint()});
    }
    return parts;
}

std::vector<LabelBox> LabelsOverlay::takenIn(const QSize& picture,
                                             const std::vector<QRect>& obstacles,
                                             const std::vector<QRectF>& boxes) const
{
    std::vector<LabelBox> taken;
    taken.reserve(obstacles.size() + boxes.size());
    for (const QRect& obstacle : obstacles) {
        taken.push_back(scaled(obstacle, 1.0));
    }
    const double scale = static_cast<double>(picture.height()) / height();
    const double left = 0.5 * (width() - picture.width() / scale);
    for (const QRectF& box : boxes) {
        taken.push_back(scaled(box.translated(-left, 0.0), scale));
    }
    return taken;
}

std::vector<LabelsOverlay::PlacedName> LabelsOverlay::namesIn(const CameraPose& camera,
                                                              const NameLabelOptions& options,
                                                              NameLabels& names) const
{
    const double scale = options.pixels_per_point;
    const auto font_for = [large_px = kLargeShare * options.viewport.height](double across_px) {
        return across_px >= large_px ? LabelFont::Large : LabelFont::Small;
    };
    const auto text_of = [&names](std::size_t name) {
        return QString::fromStdString(names.names().names()[name].name);
    };
    const auto labels = names.inPicture(camera, options, [&](std::size_t name, double across_px) {
        const QSizeF size =
            labelSize(text_of(name), labelFont(font(), font_for(across_px))) * scale;
        return LabelSize{.width_px = size.width(), .height_px = size.height()};
    });
    std::vector<PlacedName> placed;
    placed.reserve(labels.size());
    for (const NameLabel& label : labels) {
        placed.push_back({.text = text_of(label.name),
                          .box = points(label.box, scale),
                          .size = font_for(label.across_px),
                          .point = {}});
        if (label.anchor == LabelAnchor::Point) {
            placed.back().point = QPointF(label.place.x, label.place.y) / scale;
        }
    }
    return placed;
}

std::vector<LabelsOverlay::PlacedName>
LabelsOverlay::valuesIn(const std::vector<GraticuleLabel>& labels,
                        const ValueFormat& format,
                        const Viewport& viewport,
                        double scale,
                        const std::function<bool(const ScenePoint&)>& is_visible,
                        std::vector<LabelBox>& taken) const
{
    const CoordinateFormat& coordinates = format.coordinates;
    const auto text_of = [&](const GraticuleLabel& label) {
        return label.axis == GraticuleAxis::Meridian
                   ? longitudeText(label.value, coordinates, format.body,
                                   digitsFor(coordinates.angles, format.longitude_step))
                   : latitudeText(label.value, coordinates,
                                  digitsFor(coordinates.angles, format.latitude_step));
    };
    const double edge = kEdge * scale;
    const auto inside = [edge](double middle, double length, int side) {
        const double low = edge + 0.5 * length;
        return std::clamp(middle, low, std::max(low, side - low));
    };
    std::vector<LabelRequest> requests;
    for (const GraticuleLabel& label : labels) {
        const QSizeF size = labelSize(text_of(label), labelFont(font(), LabelFont::Small)) * scale;
        requests.push_back({.place = {inside(label.pixel.x, size.width(), viewport.width),
                                      inside(label.pixel.y, size.height(), viewport.height)},
                            .width_px = size.width(),
                            .height_px = size.height()});
    }
    const auto placed = placeLabels(
        requests,
        {.viewport = viewport, .gap_px = edge, .count_max = kValuesMax, .obstacles = taken},
        [&](std::size_t index) { return is_visible(labels[index].place); });
    std::vector<PlacedName> values;
    for (const PlacedLabel& label : placed) {
        taken.push_back(label.box);
        values.push_back({.text = text_of(labels[label.request]),
                          .box = points(label.box, scale),
                          .size = LabelFont::Small,
                          .point = {}});
    }
    return values;
}

QRectF LabelsOverlay::aroundCursor(QPointF place)
{
    const QPointF reach(kCursorReach, kCursorReach);
    return {place - reach, place + reach};
}

LabelBox LabelsOverlay::scaled(const QRectF& box, double scale)
{
    return {box.left() * scale, box.top() * scale, box.right() * scale, box.bottom() * scale};
}

QRectF LabelsOverlay::points(const LabelBox& box, double scale)
{
    return {QPointF(box.left, box.top) / scale, QPointF(box.right, box.bottom) / scale};
}

const QPixmap& LabelsOverlay::picture(const QString& text, LabelFont size)
{
    const QString key = text + (size == LabelFont::Large ? QLatin1Char('+') : QLatin1Char('-'));
    const auto found = pictures_.find(key);
    const double scale = devicePixelRatioF();
    if (found != pictures_.end() && found->devicePixelRatio() == scale) {
        return *found;
    }
    if (pictures_.size() > kPicturesMax) {
        pictures_.clear();
    }
    QPixmap pixmap = QPixmap::fromImage(labelPicture(text, labelFont(font(), size), scale));
    pixmap.setDevicePixelRatio(scale);
    return *pictures_.insert(key, pixmap);
}

void LabelsOverlay::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) {
        pictures_.clear();
    }
    QWidget::changeEvent(event);
}

bool LabelsOverlay::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == parent() && event->type() == QEvent::Resize) {
        setGeometry(parentWidget()->rect());
    } else if (watched != parent() &&
               (event->type() == QEvent::Show || event->type() == QEvent::Hide ||
                event->type() == QEvent::Move || event->type() == QEvent::Resize)) {
        showSightSoon(); // labels make way for it, or return
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace marsview
