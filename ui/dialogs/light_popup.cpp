#include "ui/dialogs/light_popup.h"

#include "ui/dialogs/sun_fields.h"

#include <QFormLayout>
#include <QGuiApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QRadioButton>
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
    , in_view_(new QRadioButton(tr("Fixed in the &view"), this))
    , on_body_(new QRadioButton(tr("Fixed on the &body"), this))
    , flat_(new QLabel(this))
{
    direction_ = makeDirection(); // sets other members
    sun_ = new SunFields(this);   // after it in the order of the Tab key
    setAccessibleName(tr("Light"));
    setFrameShape(QFrame::StyledPanel);
    makeFrames();
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(in_view_);
    layout->addWidget(on_body_);
    layout->addWidget(flat_);
    layout->addWidget(direction_);
    layout->addWidget(sun_);
    layout->setSizeConstraint(QLayout::SetFixedSize);
    connect(sun_, &SunFields::pointChosen, this, &LightPopup::subsolarPointChosen);
    connect(sun_, &SunFields::overheadRequested, this, &LightPopup::overheadRequested);
    showFrame();
}

// What the light is fixed in.
void LightPopup::makeFrames()
{
    in_view_->setObjectName(QStringLiteral("light of the view"));
    on_body_->setObjectName(QStringLiteral("light on the body"));
    in_view_->setToolTip(tr("The light turns with the camera: slopes look the same everywhere"));
    on_body_->setToolTip(
        tr("The sun stands over a place of the body, whose other side is dark. "
           "Moving the camera does not change the light."));
    setWhatsThis(
        tr("Where the light comes from. Fixed in the view, it has an azimuth and an "
           "altitude at the center of the picture. Fixed on the body, the sun stands over "
           "the subsolar point, and the terminator separates day and night. Mountains "
           "cast no shadows."));
    flat_->setObjectName(QStringLiteral("light of the flat map"));
    flat_->setWordWrap(true);
    for (QRadioButton* button : {in_view_, on_body_}) {
        connect(button, &QRadioButton::clicked, this, [this, button] {
            const LightFrame frame = button == on_body_ ? LightFrame::Body : LightFrame::View;
            if (is_globe_ && frame != frame_) {
                Q_EMIT frameChosen(frame);
            }
        });
    }
}

// Azimuth and altitude in the view.
QWidget* LightPopup::makeDirection()
{
    auto* direction = new QWidget(this);
    pad_ = new LightPad(direction);
    azimuth_ = new QSpinBox(direction);
    altitude_ = new QSpinBox(direction);
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
    auto* reset = new QPushButton(tr("&Reset"), direction);
    auto* layout = new QVBoxLayout(direction);
    layout->setContentsMargins(0, 0, 0, 0);
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
    return direction;
}

void LightPopup::setLook(const TerrainLook& look)
{
    pad_->setLight(look.light_azimuth, look.light_altitude);
    const QSignalBlocker azimuth_blocker(azimuth_);
    const QSignalBlocker altitude_blocker(altitude_);
    azimuth_->setValue(wrapped(asDegrees(look.light_azimuth)));
    altitude_->setValue(asDegrees(look.light_altitude));
    sun_->setPoint(look.subsolar.value_or(GeographicPoint{}));
    frame_ = look.light_frame;
    showFrame();
}

void LightPopup::setCoordinateFormat(const CoordinateFormat& format)
{
    sun_->setCoordinateFormat(format);
}

void LightPopup::setBody(const RasterInfo* map)
{
    is_globe_ = map != nullptr;
    if (map != nullptr) {
        sun_->setBody(*map);
    }
    showFrame();
}

void LightPopup::showFrame()
{
    const bool is_sun = is_globe_ && frame_ == LightFrame::Body;
    (is_sun ? on_body_ : in_view_)->setChecked(true);
    on_body_->setEnabled(is_globe_);
    flat_->setText(frame_ == LightFrame::Body
                       ? tr("The flat map has the light of the view. The light of the globe is "
                            "fixed on the body.")
                       : tr("The flat map has the light of the view. Show the globe to fix the "
                            "light on the body."));
    flat_->setVisible(!is_globe_);
    direction_->setVisible(!is_sun);
    sun_->setVisible(is_sun);
}

// Escape closes the popup without what was typed.
void LightPopup::keyPressEvent(QKeyEvent* event)
{
    if (event->matches(QKeySequence::Cancel)) {
        sun_->restore();
    }
    QFrame::keyPressEvent(event);
}

// The sun's part is wider than that of the view.
void LightPopup::resizeEvent(QResizeEvent* event)
{
    QFrame::resizeEvent(event);
    if (isVisible()) {
        stayOnScreen();
    }
}

void LightPopup::stayOnScreen()
{
    const QRect area = screen()->availableGeometry();
    const QPoint corner = pos();
    move(std::clamp(corner.x(), area.left(), std::max(area.left(), area.right() - width())),
         std::clamp(corner.y(), area.top(), std::max(area.top(), area.bottom() - height())));
}

void LightPopup::openBelow(const QWidget& anchor)
{
    adjustSize();
    move(anchor.mapToGlobal(QPoint(0, anchor.height())));
    stayOnScreen();
    show();
    const bool is_sun = on_body_->isChecked();
    (is_sun ? static_cast<QWidget*>(sun_->firstField()) : pad_)->setFocus(Qt::PopupFocusReason);
}

} // namespace marsview
