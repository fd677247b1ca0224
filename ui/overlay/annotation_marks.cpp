#include "ui/overlay/annotation_marks.h"

#include "ui/controllers/annotation_controller.h"
#include "ui/widgets/plate.h"

#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace marsview {
namespace {

constexpr double kSymbolRadius = 6.0; // of a symbol
constexpr double kSymbolRim = 1.5;
constexpr double kHiddenSymbolOpacity = 0.35;
constexpr std::size_t kLabelsMax = 200;
constexpr std::size_t kLabelTriesMax = 500; // of a picture, most of them without room

// With `count` corners, the first one at the top; every second one at `inner` of the radius.
QPainterPath starPath(QPointF place, double radius, int count, double inner)
{
    QPolygonF corners;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const double away = i % 2 == 0 ? radius : inner * radius;
        corners.append(place + QPointF(away * std::sin(angle), -away * std::cos(angle)));
    }
    QPainterPath path;
    path.addPolygon(corners);
    path.closeSubpath();
    return path;
}

} // namespace

QPainterPath symbolPath(MarkSymbol symbol, QPointF place, double radius)
{
    QPainterPath path;
    switch (symbol) {
    case MarkSymbol::Circle:
        path.addEllipse(place, radius, radius);
        break;
    case MarkSymbol::Square:
        path.addRect(QRectF(place - QPointF(0.85 * radius, 0.85 * radius),
                            QSizeF(1.7 * radius, 1.7 * radius)));
        break;
    case MarkSymbol::Triangle: {
        QPolygonF corners{place + QPointF(0.0, -radius),
                          place + QPointF(0.95 * radius, 0.75 * radius),
                          place + QPointF(-0.95 * radius, 0.75 * radius)};
        path.addPolygon(corners);
        path.closeSubpath();
        break;
    }
    case MarkSymbol::Diamond:
        path = starPath(place, 1.1 * radius, 4, 1.0);
        break;
    case MarkSymbol::Star:
        path = starPath(place, 1.25 * radius, 10, 0.45);
        break;
    case MarkSymbol::Cross:
        path.setFillRule(Qt::WindingFill);
        path.addRect(
            QRectF(place - QPointF(radius, 0.25 * radius), QSizeF(2.0 * radius, 0.5 * radius)));
        path.addRect(
            QRectF(place - QPointF(0.25 * radius, radius), QSizeF(0.5 * radius, 2.0 * radius)));
        path = path.simplified();
        break;
    }
    return path;
}

AnnotationMarks::AnnotationMarks(AnnotationController& controller, QWidget* view)
    : DrawnMarks(controller, view)
    , controller_(controller)
{
    setAccessibleName(tr("Annotations on the map"));
}

DrawnMarks::Mark AnnotationMarks::symbolMark(const AnnotationItem& item,
                                             const DrawnHandle& handle) const
{
    const bool is_current = item.id == controller_.state().current;
    const double radius = is_current ? kSymbolRadius + 1.5 : kSymbolRadius;
    const double opacity = handle.is_hidden ? kHiddenSymbolOpacity : 1.0;
    const QRectF box = boxAround(handle.place, 1.25 * radius + kSymbolRim + 1.0);
    const auto draw = [symbol = item.symbol, radius, opacity, is_current,
                       color = colorOf(controller_.colorOf(item))](QPainter& painter,
                                                                   QPointF place) {
        const QPainterPath path = symbolPath(symbol, place, radius);
        painter.setOpacity(opacity);
        if (is_current) {
            drawContrasting(painter, path, colorOf(kCurrentDrawnColor), 2.0);
        }
        painter.fillPath(path, color);
        painter.setPen(QPen(QColor(0, 0, 0, 200), kSymbolRim));
        painter.drawPath(path);
        painter.setOpacity(1.0);
    };
    if (is_current) {
        return {box, false,
                [draw, place = handle.place](QPainter& painter) { draw(painter, place); }};
    }
    // Of many that look the same, the picture is made once.
    const auto key =
        std::tuple(item.symbol, colorOf(controller_.colorOf(item)).rgb(), handle.is_hidden);
    return {box, false, [this, draw, box, key](QPainter& painter) {
                const double scale = painter.device()->devicePixelRatioF();
                if (painter.transform().type() > QTransform::TxTranslate) {
                    draw(painter, box.center()); // into a picture of another size
                    return;
                }
                if (scale != stamp_scale_) {
                    stamps_.clear();
                    stamp_scale_ = scale;
                }
                QPixmap& stamp = stamps_[key];
                if (stamp.isNull()) {
                    stamp = QPixmap((box.size() * scale).toSize());
                    stamp.setDevicePixelRatio(scale);
                    stamp.fill(Qt::transparent);
                    QPainter stamping(&stamp);
                    stamping.setRenderHint(QPainter::Antialiasing);
                    draw(stamping, QRectF(QPointF(), box.size()).center());
                }
                // On whole pixels, so that it stays sharp.
                const QPointF corner = box.topLeft() * scale;
                painter.drawPixmap(QPointF(std::round(corner.x()), std::round(corner.y())) / scale,
                                   stamp);
            }};
}

std::vector<DrawnMarks::Mark> AnnotationMarks::marks() const
{
    const AnnotationState& state = controller_.state();
    std::vector<Mark> marks;
    if (state.items.empty()) {
        return marks;
    }
    // What may have a label: where, if that is known.
    struct Named {
        std::uint32_t id = 0;
        std::optional<QPointF> place;
    };
    std::vector<Named> named;
    for (auto handle = handles().rbegin(); handle != handles().rend(); ++handle) {
        const AnnotationItem& item = *controller_.itemOf(handle->item);
        marks.push_back(item.isSingle() ? symbolMark(item, *handle) : handleMark(*handle, true));
        if (item.isSingle() && item.id != state.current && !handle->is_hidden) {
            named.push_back({.id = item.id, .place = handle->place});
        }
    }
    for (const std::uint32_t id : controller_.lineItems()) {
        if (id != state.current) {
            named.push_back({.id = id, .place = std::nullopt});
        }
    }
    // The current one first, then those that were drawn last.
    std::sort(named.begin(), named.end(),
              [](const Named& a, const Named& b) { return a.id > b.id; });
    if (controller_.current() != nullptr) {
        named.insert(named.begin(), {.id = state.current, .place = std::nullopt});
    }
    if (named.size() > kLabelTriesMax) {
        named.resize(kLabelTriesMax);
    }
    LabelRoom room = roomBeside(marks);
    std::size_t labels = 0;
    for (const Named& each : named) {
        if (labels == kLabelsMax) {
            break;
        }
        const AnnotationItem* item = controller_.itemOf(each.id);
        const auto place = each.place ? each.place : controller_.labelPlace(*item);
        if (!place || item->name.isEmpty()) {
            continue;
        }
        const QColor color =
            item->id == state.current ? colorOf(kCurrentDrawnColor) : overlayTextColor();
        if (auto label = labelMark(*place, item->name, color, room)) {
            ++labels;
            marks.push_back(std::move(*label));
        }
    }
    return marks;
}

} // namespace marsview
