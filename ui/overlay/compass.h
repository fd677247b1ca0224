// The compass over the map.
#pragma once

#include "core/view/camera.h"

#include <QAbstractButton>

namespace marsview {

/// A needle that turns with the view and lies down with it. Pressing it turns north up.
class Compass final : public QAbstractButton {
    Q_OBJECT

public:
    explicit Compass(QWidget* parent = nullptr);

    void setCamera(const OrbitCamera& camera);
    /// Where the needle's north points to, in the widget.
    QPointF northTip() const;
    QSize sizeHint() const override;

Q_SIGNALS:
    void northRequested();

protected:
    void paintEvent(QPaintEvent* event) override;
    bool hitButton(const QPoint& position) const override;
    void enterEvent(QEnterEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    QPointF onRose(double radius, Angle bearing) const;
    double radius() const;

    Angle azimuth_{};
    Angle tilt_{};
};

} // namespace marsview
