// Chooses where the light comes from.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/view/terrain_look.h"

#include <QFrame>

class QKeyEvent;
class QLabel;
class QRadioButton;
class QSpinBox;

namespace marsview {

class SunFields;
struct RasterInfo;

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

/// A small window that closes when the user clicks elsewhere: light that is fixed in the view, with
/// its direction, or on the body, with the subsolar point.
class LightPopup final : public QFrame {
    Q_OBJECT

public:
    explicit LightPopup(QWidget* parent = nullptr);

    void setLook(const TerrainLook& look);
    void setCoordinateFormat(const CoordinateFormat& format);
    /// A map of the body on the globe that is shown; null while the flat map is: it always has the
    /// light of the view.
    void setBody(const RasterInfo* map);
    /// Opens with its corner below `anchor`, on screen.
    void openBelow(const QWidget& anchor);

Q_SIGNALS:
    void lightChanged(Angle azimuth, Angle altitude);
    void frameChosen(LightFrame frame);
    void subsolarPointChosen(const GeographicPoint& point);
    /// The sun is to stand over the middle of the picture.
    void overheadRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    QWidget* makeDirection();
    void makeFrames();
    void showFrame();
    void stayOnScreen();

    QRadioButton* in_view_ = nullptr;
    QRadioButton* on_body_ = nullptr;
    QLabel* flat_ = nullptr; // why the light is not fixed on the body
    QWidget* direction_ = nullptr;
    LightPad* pad_ = nullptr;
    QSpinBox* azimuth_ = nullptr;
    QSpinBox* altitude_ = nullptr;
    SunFields* sun_ = nullptr;
    LightFrame frame_ = LightFrame::View;
    bool is_globe_ = false;
};

} // namespace marsview
