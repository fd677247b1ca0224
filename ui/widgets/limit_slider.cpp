#include "ui/widgets/limit_slider.h"

#include <QPainter>
#include <QPainterPath>
#include <QStyleOptionSlider>

namespace marsview {
namespace {

constexpr double kMarkSide = 7.0;

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

// A triangle at the lower edge, where the handle hides least of it.
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
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QPainterPath mark;
    mark.moveTo(x, height() - kMarkSide);
    mark.lineTo(x - kMarkSide / 2.0, height());
    mark.lineTo(x + kMarkSide / 2.0, height());
    mark.closeSubpath();
    painter.fillPath(mark, palette().color(QPalette::WindowText));
}

} // namespace marsview
