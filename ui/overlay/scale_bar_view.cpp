#include "ui/overlay/scale_bar_view.h"

#include "ui/text/overlay_text.h"
#include "ui/widgets/plate.h"

#include <QFontMetrics>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr int kTickHeight = 6;
constexpr double kLineWidth = 2.0;
constexpr int kLabelGap = 1;

} // namespace

ScaleBarView::ScaleBarView(QWidget* parent)
    : QWidget(parent)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Scale"));
    setAccessibleDescription(tr("Length of the bar on the ground, in the middle of the picture"));
}

void ScaleBarView::setCamera(const OrbitCamera& camera, const Viewport& viewport)
{
    setScale(metersPerPixel(camera, viewport) * devicePixelRatioF());
}

void ScaleBarView::setScale(double meters_per_pixel)
{
    meters_per_pixel_ = meters_per_pixel;
    refresh();
}

void ScaleBarView::clear()
{
    setScale(0.0);
}

void ScaleBarView::setLongestBar(int width)
{
    if (width != longest_bar_) {
        longest_bar_ = width;
        refresh();
    }
}

QSize ScaleBarView::sizeHint() const
{
    if (!bar_) {
        return {0, 0};
    }
    const QFontMetrics metrics(font());
    const int text = metrics.horizontalAdvance(lengthText(bar_->length_m));
    return {std::max(longest_bar_, text) + 2 * kPlatePadding,
            metrics.height() + kLabelGap + kTickHeight + 2 * kPlatePadding - 3};
}

void ScaleBarView::refresh()
{
    const std::optional<ScaleBar> before = bar_;
    const QSize room = sizeHint();
    bar_ = scaleBar(meters_per_pixel_, longest_bar_);
    if (bar_ && (!before || bar_->length_m != before->length_m)) {
        //: %1 is the length of the scale bar, for example "500 km"
        setAccessibleName(tr("Scale %1").arg(lengthText(bar_->length_m)));
    }
    if (sizeHint() != room) {
        updateGeometry();
        Q_EMIT roomChanged();
    }
    // A change that moves no pixel is none.
    if (bar_.has_value() != before.has_value() ||
        (bar_ && (bar_->length_m != before->length_m ||
                  std::abs(bar_->width_px - before->width_px) * devicePixelRatioF() > 0.1))) {
        update();
    }
}

void ScaleBarView::paintEvent(QPaintEvent* /*event*/)
{
    if (!bar_) {
        return;
    }
    QPainter painter(this);
    const QFontMetrics metrics(font());
    const QString text = lengthText(bar_->length_m);
    const QRectF plate(rect());
    drawPlate(painter, plate);
    drawText(painter, QRectF(plate.left(), kPlatePadding - 3, plate.width(), metrics.height()),
             Qt::AlignCenter, text);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(overlayTextColor(), kLineWidth, Qt::SolidLine, Qt::FlatCap, Qt::MiterJoin));
    const double bottom = height() - kPlatePadding;
    const double left = plate.center().x() - bar_->width_px / 2.0;
    const double right = left + bar_->width_px;
    // The outer edges of the end marks are as far apart as the length is.
    const double inset = kLineWidth / 2.0;
    painter.drawPolyline(QPolygonF{QPointF(left + inset, bottom - kTickHeight),
                                   QPointF(left + inset, bottom), QPointF(right - inset, bottom),
                                   QPointF(right - inset, bottom - kTickHeight)});
}

} // namespace marsview
