#include "ui/widgets/light_popup.h"

#include "core/view/terrain_look.h"

#include <QFormLayout>
#include <QGuiApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QScreen>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr int kAltitudeMin = 1; // along the horizon nothing is lit
constexpr int kKeyStep = 5;     // degrees

int asDegrees(Angle angle)
{
    return static_cast<int>(std::lround(angle.degrees()));
}

int wrapped(int azimuth_deg)
{
    return ((azimuth_deg % 360) + 360) % 360;
}

} // namespace

LightPad::LightPad(QWidget* parent)
    : QWidget(parent)
{
    setAccessibleName(tr("Direction of the light"));
    setAccessibleDescription(tr("Left and right turn the light, up and down raise and lower it"));
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    setCursor(Qt::CrossCursor);
}

void LightPad::setLight(Angle azimuth, Angle altitude)
{
    azimuth_deg_ = azimuth.degrees();
    altitude_deg_ = altitude.degrees();
    update();
}

double LightPad::radius() const
{
    return std::min(width(), height()) / 2.0 - 14.0;
}

void LightPad::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QPointF center(width() / 2.0, height() / 2.0);
    const double r = radius();
    painter.setPen(QPen(palette().color(hasFocus() ? QPalette::Highlight : QPalette::Mid), 2));
    painter.setBrush(palette().base());
    painter.drawEllipse(center, r, r);
    painter.setPen(palette().color(QPalette::Mid));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(center, r / 2.0, r / 2.0);
    painter.drawLine(center - QPointF(r, 0), center + QPointF(r, 0));
    painter.drawLine(center - QPointF(0, r), center + QPointF(0, r));
    painter.setPen(palette().color(QPalette::WindowText));
    const QRectF north(center.x() - 10, center.y() - r - 14, 20, 13);
    //: North, on a compass
    painter.drawText(north, Qt::AlignCenter, tr("N"));
    const double azimuth = Angle::degrees(azimuth_deg_).radians();
    const double share = (90.0 - altitude_deg_) / 90.0;
    const QPointF light = center + QPointF(std::sin(azimuth), -std::cos(azimuth)) * (share * r);
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1.5));
    painter.setBrush(QColor(255, 205, 84));
    painter.drawEllipse(light, 6.0, 6.0);
}

void LightPad::mousePressEvent(QMouseEvent* event)
{
    if (event->button() == Qt::LeftButton) {
        moveTo(event->position());
    }
}

void LightPad::mouseMoveEvent(QMouseEvent* event)
{
    if ((event->buttons() & Qt::LeftButton) != 0) {
        moveTo(event->position());
    }
}

void LightPad::moveTo(QPointF position)
{
    const QPointF from_center = position - QPointF(width() / 2.0, height() / 2.0);
    const double azimuth = Angle::radians(std::atan2(from_center.x(), -from_center.y())).degrees();
    const double share = std::hypot(from_center.x(), from_center.y()) / radius();
    const int altitude = static_cast<int>(std::lround(90.0 * (1.0 - std::min(share, 1.0))));
    Q_EMIT moved(wrapped(static_cast<int>(std::lround(azimuth))), std::max(kAltitudeMin, altitude));
}

void LightPad::keyPressEvent(QKeyEvent* event)
{
    int azimuth = static_cast<int>(std::lround(azimuth_deg_));
    int altitude = static_cast<int>(std::lround(altitude_deg_));
    switch (event->key()) {
    case Qt::Key_Left:
        azimuth -= kKeyStep;
        break;
    case Qt::Key_Right:
        azimuth += kKeyStep;
        break;
    case Qt::Key_Up:
        altitude += kKeyStep;
        break;
    case Qt::Key_Down:
        altitude -= kKeyStep;
        break;
    default:
        QWidget::keyPressEvent(event);
        return;
    }
    Q_EMIT moved(wrapped(azimuth), std::clamp(altitude, kAltitudeMin, 90));
}

LightPopup::LightPopup(QWidget* parent)
    : QFrame(parent, Qt::Popup)
    , pad_(new LightPad(this))
    , azimuth_(new QSpinBox(this))
    , altitude_(new QSpinBox(this))
{
    setAccessibleName(tr("Light"));
    setFrameShape(QFrame::StyledPanel);
    azimuth_->setAccessibleName(tr("Azimuth of the light, clockwise from north"));
    azimuth_->setRange(0, 359);
    azimuth_->setWrapping(true);
    altitude_->setAccessibleName(tr("Altitude of the light above the horizon"));
    altitude_->setRange(kAltitudeMin, 90);
    for (QSpinBox* box : {azimuth_, altitude_}) {
        box->setSuffix(QStringLiteral("°"));
        box->setSingleStep(kKeyStep);
    }
    auto* form = new QFormLayout;
    form->addRow(tr("A&zimuth"), azimuth_);
    form->addRow(tr("A&ltitude"), altitude_);
    //: Resets the light to the north-west
    auto* reset = new QPushButton(tr("&Reset"), this);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(pad_, 0, Qt::AlignHCenter);
    layout->addLayout(form);
    layout->addWidget(reset);

    const auto notify = [this] {
        Q_EMIT lightChanged(Angle::degrees(azimuth_->value()), Angle::degrees(altitude_->value()));
    };
    connect(azimuth_, &QSpinBox::valueChanged, this, notify);
    connect(altitude_, &QSpinBox::valueChanged, this, notify);
    connect(pad_, &LightPad::moved, this, [this](int azimuth_deg, int altitude_deg) {
        Q_EMIT lightChanged(Angle::degrees(azimuth_deg), Angle::degrees(altitude_deg));
    });
    connect(reset, &QPushButton::clicked, this, [this] {
        const TerrainLook look;
        Q_EMIT lightChanged(look.light_azimuth, look.light_altitude);
    });
}

void LightPopup::setLight(Angle azimuth, Angle altitude)
{
    pad_->setLight(azimuth, altitude);
    const QSignalBlocker azimuth_blocker(azimuth_);
    const QSignalBlocker altitude_blocker(altitude_);
    azimuth_->setValue(wrapped(asDegrees(azimuth)));
    altitude_->setValue(asDegrees(altitude));
}

void LightPopup::openBelow(const QWidget& anchor)
{
    adjustSize();
    QPoint corner = anchor.mapToGlobal(QPoint(0, anchor.height()));
    const QRect screen = anchor.screen()->availableGeometry();
    corner.setX(
        std::clamp(corner.x(), screen.left(), std::max(screen.left(), screen.right() - width())));
    corner.setY(
        std::clamp(corner.y(), screen.top(), std::max(screen.top(), screen.bottom() - height())));
    move(corner);
    show();
    pad_->setFocus(Qt::PopupFocusReason);
}

} // namespace marsview
