// The stereonet of attitudes, or the rose diagram of their strikes.
#pragma once

#include "core/measure/statistics/orientations.h"

#include <QString>
#include <QWidget>

#include <cstdint>
#include <optional>
#include <vector>

class QPainter;

namespace marsview {

/// A plane on the net.
struct NetPlane {
    std::uint32_t id = 0;
    QString name;
    PlaneOrientation plane;
    std::vector<std::vector<NetPoint>> ellipse; // of the 95 % confidence around its pole
};

/// Equal-area net of the lower hemisphere: great circles, poles and their ellipses, and the mean
/// pole; or a rose of strikes in sectors of 10°. A click chooses the nearest pole. Drawn by
/// QPainter, because plot libraries have no stereonet.
class StereonetPlot final : public QWidget {
    Q_OBJECT

public:
    enum class Diagram { Stereonet, Rose };

    explicit StereonetPlot(QWidget* parent = nullptr);

    /// `current` is highlighted.
    void setPlanes(std::vector<NetPlane> planes, std::uint32_t current);
    const std::vector<NetPlane>& planes() const noexcept { return planes_; }
    void setDiagram(Diagram diagram);
    /// Empty without planes.
    const std::optional<OrientationStatistics>& statistics() const noexcept { return statistics_; }
    /// Where the pole of a plane is drawn, in the widget; empty for an unknown plane.
    std::optional<QPointF> placeOf(std::uint32_t id) const;

    /// Of the picture that savePicture() draws, in units; its labels have the font of the widget.
    static QSize pictureSize();
    /// The diagram in the format that the suffix names: png, svg or pdf. False where the file
    /// cannot be written.
    bool savePicture(const QString& path) const;

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

Q_SIGNALS:
    void planeChosen(std::uint32_t id);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;

private:
    struct Colors {
        QColor paper;
        QColor ink;
        QColor faint;
        QColor highlight;
    };
    void draw(QPainter& painter, const QRectF& area, const Colors& colors) const;
    void drawFrame(QPainter& painter, const QRectF& circle, const Colors& colors) const;
    void drawNet(QPainter& painter, const QRectF& circle, const Colors& colors) const;
    void drawRose(QPainter& painter, const QRectF& circle, const Colors& colors) const;

    std::vector<NetPlane> planes_;
    std::uint32_t current_ = 0;
    Diagram diagram_ = Diagram::Stereonet;
    std::optional<OrientationStatistics> statistics_;
};

} // namespace marsview
