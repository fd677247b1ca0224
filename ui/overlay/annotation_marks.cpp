#include "ui/overlay/annotation_marks.h"

#include "ui/controllers/annotation_controller.h"
#include "ui/widgets/plate.h"

#include <QImage>
#include <QPainter>
#include <QPen>
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

QPen rimPen()
{
    return {QColor(0, 0, 0, 200), kSymbolRim};
}

// From its place to the edges of a symbol's box.
double reachOf(double radius)
{
    return 1.25 * radius + kSymbolRim + 1.0;
}

// In the order of MarkSymbol.
std::shared_ptr<const DotStamps> stampsFor(double scale)
{
    auto stamps = std::make_shared<DotStamps>();
    stamps->side_px = static_cast<int>(std::lround(2.0 * reachOf(kSymbolRadius) * scale));
    stamps->count = static_cast<int>(kMarkSymbols.size());
    const QSize size(stamps->side_px, stamps->side_px);
    const double middle = 0.5 * stamps->side_px / scale;
    for (const MarkSymbol symbol : kMarkSymbols) {
        const QPainterPath path = symbolPath(symbol, {middle, middle}, kSymbolRadius);
        const auto drawn = [&](const auto& draw) {
            QImage image(size, QImage::Format_ARGB32_Premultiplied);
            image.fill(Qt::transparent);
            QPainter painter(&image);
            painter.setRenderHint(QPainter::Antialiasing);
            painter.scale(scale, scale);
            draw(painter);
            painter.end();
            return image;
        };
        const QImage inside = drawn([&](QPainter& painter) { painter.fillPath(path, Qt::white); });
        const QImage rim = drawn([&](QPainter& painter) { painter.strokePath(path, rimPen()); });
        int edge = stamps->side_px / 2; // around it, empty
        for (int y = 0; y < size.height(); ++y) {
            for (int x = 0; x < size.width(); ++x) {
                if (qAlpha(inside.pixel(x, y)) > 0 || qAlpha(rim.pixel(x, y)) > 0) {
                    edge = std::min({edge, x, y, size.width() - 1 - x, size.height() - 1 - y});
                }
                stamps->coverage.push_back({static_cast<std::uint8_t>(qAlpha(inside.pixel(x, y))),
                                            static_cast<std::uint8_t>(qAlpha(rim.pixel(x, y)))});
            }
        }
        stamps->filled_sides_px.push_back(stamps->side_px - 2 * edge);
    }
    return stamps;
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

// The view draws points that are not selected, of which there may be many.
bool AnnotationMarks::isOnTerrain(const DrawnHandle& handle) const
{
    return handle.is_dot && handle.item != controller_.state().current;
}

void AnnotationMarks::showOnTerrain()
{
    const double scale = devicePixelRatioF();
    if (!stamps_ || scale != stamps_scale_) {
        stamps_ = stampsFor(scale);
        stamps_scale_ = scale;
    }
    DotSet set;
    set.stamps = stamps_;
    const std::vector<DrawnHandle>& all = handles();
    const std::vector<ScenePoint>& places = controller_.handlePlaces();
    set.dots.reserve(all.size());
    for (std::size_t i = all.size(); i-- > 0;) {
        if (isOnTerrain(all[i])) {
            const AnnotationItem& item = *controller_.itemOf(all[i].item);
            set.dots.push_back({.place = places[i],
                                .color = controller_.colorOf(item),
                                .symbol = static_cast<std::uint8_t>(item.symbol)});
        }
    }
    controller_.showDots(std::move(set));
}

DrawnMarks::Mark AnnotationMarks::symbolMark(const AnnotationItem& item,
                                             const DrawnHandle& handle) const
{
    const bool is_current = item.id == controller_.state().current;
    const double radius = is_current ? kSymbolRadius + 1.5 : kSymbolRadius;
    const double opacity = handle.is_hidden ? kHiddenSymbolOpacity : 1.0;
    return {boxAround(handle.place, reachOf(radius)), false,
            [symbol = item.symbol, radius, opacity, is_current, place = handle.place,
             color = colorOf(controller_.colorOf(item))](QPainter& painter) {
                const QPainterPath path = symbolPath(symbol, place, radius);
                painter.setOpacity(opacity);
                if (is_current) {
                    drawContrasting(painter, path, colorOf(kCurrentDrawnColor), 2.0);
                }
                painter.fillPath(path, color);
                painter.setPen(rimPen());
                painter.drawPath(path);
                painter.setOpacity(1.0);
            }};
}

std::vector<DrawnMarks::Mark> AnnotationMarks::marksOnTerrain() const
{
    std::vector<Mark> marks;
    for (auto handle = handles().rbegin(); handle != handles().rend(); ++handle) {
        if (isOnTerrain(*handle)) {
            marks.push_back(symbolMark(*controller_.itemOf(handle->item), *handle));
        }
    }
    return marks;
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
    std::vector<QRectF> boxes;
    for (auto handle = handles().rbegin(); handle != handles().rend(); ++handle) {
        const bool is_on_terrain = isOnTerrain(*handle);
        if (!is_on_terrain) {
            marks.push_back(handle->is_dot ? symbolMark(*controller_.itemOf(handle->item), *handle)
                                           : handleMark(*handle, true));
        }
        if (boxes.size() < kMarksMax) {
            boxes.push_back(is_on_terrain ? boxAround(handle->place, reachOf(kSymbolRadius))
                                          : marks.back().box);
        }
        if (is_on_terrain && !handle->is_hidden) {
            named.push_back({.id = handle->item, .place = handle->place});
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
    LabelRoom room = roomBeside(boxes);
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
        if (auto label = labelMark(*place, item->name, room)) {
            ++labels;
            marks.push_back(std::move(*label));
        }
    }
    return marks;
}

} // namespace marsview
