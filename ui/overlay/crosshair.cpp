#include "ui/overlay/crosshair.h"

#include "ui/widgets/plate.h"

#include <QPainterPath>

namespace marsview {
namespace {

constexpr int kCrossSide = 33; // odd: the middle is a pixel
constexpr double kArm = 14.0;
constexpr double kOpen = 5.0;

} // namespace

Crosshair::Crosshair(QWidget* parent)
    : QWidget(parent)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAccessibleName(tr("Crosshair"));
    resize(sizeHint());
    hide();
}

QSize Crosshair::sizeHint() const
{
    return {kCrossSide, kCrossSide};
}

void Crosshair::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    const QPointF middle(kCrossSide / 2.0, kCrossSide / 2.0);
    QPainterPath path;
    for (const QPointF direction : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
        path.moveTo(middle + direction * kOpen);
        path.lineTo(middle + direction * kArm);
    }
    drawContrasting(painter, path, overlayTextColor(), 1.5);
}

} // namespace marsview
