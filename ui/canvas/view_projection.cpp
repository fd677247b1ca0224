#include "ui/canvas/view_projection.h"

#include <QWidget>

#include <algorithm>
#include <cmath>

namespace marsview {

Viewport viewportOf(const QWidget& view)
{
    const double scale = view.devicePixelRatioF();
    return {.width = std::max(1, qRound(view.width() * scale)),
            .height = std::max(1, qRound(view.height() * scale))};
}

ViewProjection::ViewProjection(const QWidget& view,
                               const ShownScene& scene,
                               const CameraController& camera)
    : view_(view)
    , scene_(scene)
    , camera_(camera)
{}

double ViewProjection::pixelsPerPoint() const
{
    return view_.devicePixelRatioF();
}

QPointF ViewProjection::center() const
{
    return QRectF(view_.rect()).center();
}

PixelPoint ViewProjection::pixelAt(QPointF position) const
{
    const QPointF pixel = position * pixelsPerPoint();
    return {pixel.x(), pixel.y()};
}

std::optional<GroundPoint> ViewProjection::groundUnder(QPointF position) const
{
    return scene_.cast(pickRay(camera_.camera(), viewportOf(view_), pixelAt(position)));
}

std::optional<GroundPoint> ViewProjection::placeUnder(QPointF position) const
{
    const Ray ray = pickRay(camera_.camera(), viewportOf(view_), pixelAt(position));
    const auto hit = scene_.cast(ray);
    return hit ? hit : scene_.voidOn(ray);
}

ScenePoint ViewProjection::anchorAt(QPointF position, const OrbitCamera& camera) const
{
    const Ray ray = pickRay(camera_.camera(), viewportOf(view_), pixelAt(position));
    const auto hit = scene_.cast(ray);
    return hit ? ray.at(hit->distance_m) : anchorBesideMap(camera, ray);
}

std::optional<QPointF> ViewProjection::positionOf(const ScenePoint& place) const
{
    const auto pixel = project(camera_.camera(), viewportOf(view_), place);
    if (!pixel || !std::isfinite(pixel->x)) {
        return std::nullopt;
    }
    return QPointF(pixel->x, pixel->y) / pixelsPerPoint();
}

bool ViewProjection::isInPicture(const ScenePoint& place) const
{
    const auto position = positionOf(place);
    return position && QRectF(view_.rect()).contains(*position);
}

double ViewProjection::metersPerPoint(const ScenePoint& place) const
{
    return metersPerPixel(camera_.camera(), viewportOf(view_), place) * pixelsPerPoint();
}

} // namespace marsview
