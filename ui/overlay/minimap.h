// The overview of the whole map, and the way to any place on it.
#pragma once

#include "core/view/camera.h"
#include "core/view/footprint.h"

#include <QImage>
#include <QLineF>
#include <QPainterPath>
#include <QPixmap>
#include <QPolygonF>
#include <QString>
#include <QTransform>
#include <QWidget>

#include <optional>
#include <vector>

namespace marsview {

/// What a camera over a body sees, on a map of longitude (x) and latitude (y) in degrees or on a
/// disc.
struct MinimapSight {
    ScenePoint target;
    ScenePoint eye;
    Angle heading{};             // of the view, clockwise from up
    Angle half_width{};          // to the left and right edge of the picture
    bool is_from_above = true;   // the heading is not shown
    QImage seen{};               // covers the map; opaque where the picture is
    std::vector<QLineF> edges{}; // around it
    double share = 0.0;          // of the map
    QString place{};             // the target in words, needed on a disc
};

/// A map that is the disc within its square, around a pole.
struct MinimapDisc {
    struct Label {
        QPointF at; // in the scene
        QString text;
    };
    QString caption; // short, may have two lines; in the upper left corner
    QString name;    // for screen readers
    std::vector<QPolygonF> lines;
    std::vector<Label> labels;
};

/// Shows a map from above, north up and east to the right however its raster lies, with the part
/// that the camera sees and the camera itself. A press or drag, or the arrow keys while it has the
/// focus, ask to look at another place.
class Minimap final : public QWidget {
    Q_OBJECT

public:
    explicit Minimap(QWidget* parent = nullptr);

    /// The picture covers the pixels of a raster of columns × rows samples from edge to edge, as
    /// core/view/map_preview.h makes it. A null image is shown as an empty plate.
    void
    setMap(const QImage& preview, const SceneFrame& frame, std::size_t columns, std::size_t rows);
    /// Removes the map.
    void clear();
    /// Lines on the map, in scene coordinates; setMap() and clear() remove them. One that is too
    /// small to be seen becomes a mark.
    void setOutlines(std::vector<QPolygonF> outlines);
    /// Makes the map a disc; setMap() and clear() undo it.
    void setDisc(const MinimapDisc& disc);
    /// Instead of a camera over a plane.
    void setSight(const MinimapSight& sight);
    /// `viewport` is the map's in device pixels.
    void setCamera(const OrbitCamera& camera, const Viewport& viewport);

    /// How large the widget may be, its rim included. Its size is the largest within that keeps the
    /// map's aspect.
    void setLargestSize(QSize size);
    /// Empty without a map and where the largest size has no room for a useful picture.
    QSize sizeHint() const override;

    /// Converts a scene point to a widget position, and back: at the height of the camera's target,
    /// and clamped to the map's edge if the position is outside.
    QPointF positionOf(const ScenePoint& place) const;
    ScenePoint placeAt(QPointF position) const;

    /// Between a press and the release: another map would move the places under the pointer.
    bool isDragged() const noexcept { return is_dragged_; }

Q_SIGNALS:
    /// The camera should look at this place; its height is that of the camera's target.
    void placeRequested(const ScenePoint& place);
    void dragEnded();
    /// The preferred size has changed.
    void roomChanged();

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    struct Bounds {
        double west = 0.0; // scene meters
        double east = 0.0;
        double south = 0.0;
        double north = 0.0;
    };

    ScenePoint onMap(const ScenePoint& place) const;
    QPainterPath edge() const;
    std::optional<ScenePoint> target() const;
    void place();
    void drawMap(QPainter& painter) const;
    void drawLines(QPainter& painter) const;
    void drawLabels(QPainter& painter) const;
    void drawCamera(QPainter& painter) const;
    void drawSight(QPainter& painter) const;
    void drawWedge(QPainter& painter, QPointF eye, const std::vector<QPointF>& arc) const;
    void describe();

    QImage preview_;
    std::optional<MapPlan> map_;
    Bounds bounds_;
    std::optional<OrbitCamera> camera_;
    std::optional<MinimapSight> sight_;
    std::optional<MinimapDisc> disc_;
    std::vector<QPolygonF> outlines_;
    Viewport viewport_;
    QSize largest_size_{220, 160};
    double pixels_per_meter_ = 1.0;
    QPointF middle_;       // of the bounds, in the widget
    QTransform from_grid_; // to the widget
    QPixmap drawn_map_;    // for this size and pixel ratio; null when it has to be drawn
    std::vector<GridPoint> footprint_;
    bool is_dragged_ = false;
};

} // namespace marsview
