#include "ui/panels/limit_slider.h"

#include <QPainter>
#include <QRegion>
#include <QStyleOptionSlider>

namespace marsview {
namespace {

constexpr double kMarkWidth = 1.5;

} // namespace

LimitSlider::LimitSlider(QWidget* parent)
    : QSlider(Qt::Horizontal, parent)
{}

void LimitSlider::setLimit(std::optional<int> value)
{
    if (value && *value >= maximum()) {
        value.reset();
    }
    if (value != limit_) {
        limit_ = value;
        update();
    }
}

// Beyond the limit the groove is faded.
void LimitSlider::paintEvent(QPaintEvent* event)
{
    QSlider::paintEvent(event);
    if (!limit_) {
        return;
    }
    QStyleOptionSlider option;
    initStyleOption(&option);
    const QRect groove =
        style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderGroove, this);
    const int handle =
        style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, this).width();
    const double x = groove.left() + handle / 2.0 +
                     QStyle::sliderPositionFromValue(minimum(), maximum(), *limit_,
                                                     groove.width() - handle, option.upsideDown);
    QRectF beyond(groove);
    (option.upsideDown ? beyond.setRight(x) : beyond.setLeft(x));
    QColor cover = palette().color(QPalette::Window);
    cover.setAlpha(170);
    QPainter painter(this);
    // The handle stays as it is.
    const QRect handle_now =
        style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, this);
    painter.setClipRegion(QRegion(rect()) - handle_now);
    painter.fillRect(beyond, cover);
    painter.fillRect(QRectF(x - kMarkWidth / 2.0, 0.0, kMarkWidth, height()),
                     palette().color(QPalette::WindowText));
}

} // namespace marsview
