// Between positions in the view and places of the scene, as the camera sees them now.
#pragma once

#include "core/view/camera.h"
#include "ui/canvas/camera_controller.h"
#include "ui/canvas/shown_scene.h"

#include <QPointF>

#include <optional>

class QWidget;

namespace marsview {

/// The size of the widget's picture, in pixels of its frame buffer.
Viewport viewportOf(const QWidget& view);

/// Positions are those of the widget, in points.
class ViewProjection {
public:
    /// All outlive this.
    ViewProjection(const QWidget& view, const ShownScene& scene, const CameraController& camera);

    double pixelsPerPoint() const;
    QPointF center() const;
    PixelPoint pixelAt(QPointF position) const;
    /// The terrain behind a position, at full resolution.
    std::optional<GroundPoint> groundUnder(QPointF position) const;
    /// The same; where a map has no data, the place there, without a height.
    std::optional<GroundPoint> placeUnder(QPointF position) const;
    /// The same; off the terrain, anchorBesideMap() of `camera`.
    ScenePoint anchorAt(QPointF position, const OrbitCamera& camera) const;
    /// Nothing where the place is behind the eye.
    std::optional<QPointF> positionOf(const ScenePoint& place) const;
    bool isInPicture(const ScenePoint& place) const;
    /// The length of a point of the screen at a place, in scene meters.
    double metersPerPoint(const ScenePoint& place) const;

private:
    const QWidget& view_;
    const ShownScene& scene_;
    const CameraController& camera_;
};

} // namespace marsview
