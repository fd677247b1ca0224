#include "ui/drawing/drawn_leg.h"

#include "ui/drawing/drawing_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace marsview {
namespace {

double distanceToSegment(QPointF position, QPointF from, QPointF to)
{
    const QPointF along = to - from;
    const double length_squared = QPointF::dotProduct(along, along);
    const double share =
        length_squared > 0.0
            ? std::clamp(QPointF::dotProduct(position - from, along) / length_squared, 0.0, 1.0)
            : 0.0;
    const QPointF away = position - (from + share * along);
    return std::hypot(away.x(), away.y());
}

QRectF including(const std::optional<QRectF>& box, QPointF place)
{
    return box ? QRectF(
                     QPointF(std::min(box->left(), place.x()), std::min(box->top(), place.y())),
                     QPointF(std::max(box->right(), place.x()), std::max(box->bottom(), place.y())))
               : QRectF(place, QSizeF());
}

} // namespace

const DrawnLeg* legNear(const std::vector<DrawnLeg>& legs,
                        const DrawingScene& scene,
                        QPointF position,
                        double reach)
{
    const DrawnLeg* nearest = nullptr;
    for (const DrawnLeg& leg : legs) {
        std::optional<QPointF> last;
        for (const ScenePoint& point : leg.run.points) {
            const auto place = scene.positionOf(point);
            if (place && last) {
                const double away = distanceToSegment(position, *last, *place);
                if (away <= reach) {
                    reach = away;
                    nearest = &leg;
                }
            }
            last = place;
        }
    }
    return nearest;
}

std::vector<QRectF> boxesAround(const std::vector<DrawnLeg>& legs,
                                const DrawingScene& scene,
                                const std::function<bool(const DrawnLeg&)>& wanted)
{
    constexpr double kSide = 24.0;           // points
    constexpr double kMargin = 3.0;          // half a line, and some room
    constexpr std::size_t kPointsMax = 5000; // beyond, no name has room anyway
    std::vector<QRectF> boxes;
    std::size_t points = 0;
    const QRectF sight(scene.view().rect());
    for (const DrawnLeg& leg : legs) {
        if (!wanted(leg)) {
            continue;
        }
        std::optional<QRectF> box;
        const auto end_box = [&] {
            if (box) {
                boxes.push_back(box->adjusted(-kMargin, -kMargin, kMargin, kMargin));
            }
            box.reset();
        };
        for (const ScenePoint& point : leg.run.points) {
            if (++points > kPointsMax) {
                return boxes;
            }
            const auto place = scene.positionOf(point);
            if (!place || !sight.contains(*place)) {
                end_box();
                continue;
            }
            const QRectF wider = including(box, *place);
            if (wider.width() > kSide || wider.height() > kSide) {
                end_box();
            }
            box = box ? wider : QRectF(*place, QSizeF());
        }
        end_box();
    }
    return boxes;
}

} // namespace marsview
