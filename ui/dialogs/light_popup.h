// Chooses the direction of the light.
#pragma once

#include "core/base/angle.h"

#include <QFrame>

class QSpinBox;

namespace marsview {

/// The sky from above, with the light in it: the middle is overhead, the rim the horizon, north is
/// up. Pointer and arrow keys move the light.
class LightPad final : public QWidget {
    Q_OBJECT

public:
    explicit LightPad(QWidget* parent = nullptr);

    void setLight(Angle azimuth, Angle altitude);
    QSize sizeHint() const override { return {132, 132}; }

Q_SIGNALS:
    /// Whole degrees.
    void moved(int azimuth_deg, int altitude_deg);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    double radius() const;
    void moveTo(QPointF position);

    double azimuth_deg_ = 315.0;
    double altitude_deg_ = 45.0;
};

/// A small window that closes when the user clicks elsewhere.
class LightPopup final : public QFrame {
    Q_OBJECT

public:
    explicit LightPopup(QWidget* parent = nullptr);

    void setLight(Angle azimuth, Angle altitude);
    /// Opens with its corner below `anchor`, on screen.
    void openBelow(const QWidget& anchor);

Q_SIGNALS:
    void lightChanged(Angle azimuth, Angle altitude);

private:
    LightPad* pad_ = nullptr;
    QSpinBox* azimuth_ = nullptr;
    QSpinBox* altitude_ = nullptr;
};

} // namespace marsview
