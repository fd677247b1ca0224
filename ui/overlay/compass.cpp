#include "ui/overlay/compass.h"

#include "ui/text/overlay_text.h"
#include "ui/widgets/plate.h"

#include <QFontMetrics>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// A needle seen from the side would be a line; it lies down only so far.
constexpr double kFlattest = 0.65;

constexpr double kNeedleShare = 0.58; // of the plate's radius; beyond it is the letter
constexpr double kNeedleWidthShare = 0.17;
constexpr double kLetterShare = 0.8;
constexpr double kLetterHeightShare = 0.38;

} // namespace

Compass::Compass(QWidget* parent)
    : QAbstractButton(parent)
{
    setFocusPolicy(Qt::TabFocus); // a click leaves the focus with the map
    setCursor(Qt::PointingHandCursor);
    setToolTip(tr("Turn north up"));
    setAccessibleDescription(tr("Compass; press to turn north up"));
    connect(this, &QAbstractButton::clicked, this, &Compass::northRequested);
    //: %1 is a heading, for example "332° (north-north-west)"
    setAccessibleName(tr("Looking toward %1").arg(headingText(azimuth_)));
}

void Compass::setCamera(const OrbitCamera& camera)
{
    if (camera.azimuth == azimuth_ && camera.tilt == tilt_) {
        return;
    }
    azimuth_ = camera.azimuth;
    tilt_ = camera.tilt;
    const QString name = tr("Looking toward %1").arg(headingText(azimuth_));
    if (name != accessibleName()) {
        setAccessibleName(name);
    }
    update();
}

QPointF Compass::northTip() const
{
    return onRose(radius() * kNeedleShare, {});
}

QSize Compass::sizeHint() const
{
    const int side = std::max(56, QFontMetrics(font()).height() * 7 / 2);
    return {side, side};
}

double Compass::radius() const
{
    return std::min(width(), height()) / 2.0;
}

// The place of a bearing on a level circle around the middle, as the camera sees it.
QPointF Compass::onRose(double radius, Angle bearing) const
{
    const double turn = bearing.radians() - azimuth_.radians();
    const double flat = std::max(kFlattest, std::cos(tilt_.radians()));
    return QPointF(width() / 2.0, height() / 2.0) +
           QPointF(std::sin(turn), -std::cos(turn) * flat) * radius;
}

void Compass::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QPointF middle(width() / 2.0, height() / 2.0);
    const double r = radius();
    painter.setPen(Qt::NoPen);
    QColor plate = plateColor();
    if (underMouse()) {
        plate = QColor(38, 44, 58, plate.alpha());
    }
    painter.setBrush(plate);
    painter.drawEllipse(middle, r, r);

    painter.setBrush(overlayFaintColor());
    for (const double bearing : {90.0, 180.0, 270.0}) {
        painter.drawEllipse(onRose(r * kLetterShare, Angle::degrees(bearing)), 1.5, 1.5);
    }
    const double length = r * kNeedleShare;
    const double half_width = r * kNeedleWidthShare;
    const QPointF east = onRose(half_width, Angle::degrees(90.0));
    const QPointF west = onRose(half_width, Angle::degrees(270.0));
    painter.setBrush(QColor(235, 87, 62));
    painter.drawPolygon(QPolygonF{onRose(length, {}), east, west});
    painter.setBrush(QColor(200, 205, 214));
    painter.drawPolygon(QPolygonF{onRose(length, Angle::degrees(180.0)), east, west});

    QFont letter_font = font();
    letter_font.setBold(true);
    letter_font.setPixelSize(std::max(8, static_cast<int>(std::lround(r * kLetterHeightShare))));
    painter.setFont(letter_font);
    const QPointF at = onRose(r * kLetterShare, {});
    //: The letter for north on the compass
    drawText(painter, QRectF(at.x() - r, at.y() - r, 2.0 * r, 2.0 * r), Qt::AlignCenter, tr("N"));
    if (hasFocus()) {
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(overlayFocusColor(), 2.0));
        painter.drawEllipse(middle, r - 1.0, r - 1.0);
    }
}

bool Compass::hitButton(const QPoint& position) const
{
    const QPointF from_middle = position - QPointF(width() / 2.0, height() / 2.0);
    return std::hypot(from_middle.x(), from_middle.y()) <= radius();
}

void Compass::enterEvent(QEnterEvent* event)
{
    QAbstractButton::enterEvent(event);
    update();
}

void Compass::leaveEvent(QEvent* event)
{
    QAbstractButton::leaveEvent(event);
    update();
}

} // namespace marsview
